#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/results/run_data.h"
#include "engine/document/node.h"

namespace etude {

/// What a scenario says should come out: judged after the run, shown in the report.
struct Expectation {
  std::string metric;
  std::string of;                           ///< the method judged
  std::string below, above;                 ///< the method it is compared with on the same worlds; at most one is set
  std::optional<double> at_most, at_least;  ///< or the bound its statistic must keep
  std::string statistic = "median";         ///< median, mean or p95; for bounds
  std::vector<Setting> where;               ///< judged in these conditions only; empty = in all of them
  Place place;
};

/// One value of each swept parameter, and the scenario's mapping with those values put in.
struct Condition {
  std::vector<Setting> settings;  ///< empty when nothing is swept
  Node node;
};

/// Which cells keep their motions for videos.
struct RecordingWish {
  std::vector<std::string> methods;
  std::vector<int> trials;
};

/// A question put to several methods on the same worlds (design.md §5), as its file says it. The keys
/// of its task are read by the task itself, from each condition's mapping.
struct Scenario {
  std::string file;
  std::string text;  ///< the whole file: a run must be repeatable from its manifest
  std::string name;
  std::string question;
  std::string task;
  std::vector<std::string> clips;  ///< references as written
  int trials = 1;
  std::optional<std::uint64_t> seed;
  std::vector<Condition> conditions;  ///< at least one
  std::vector<std::string> method_names;
  std::vector<std::string> baselines;  ///< of each method: the one it is compared with; the first has itself
  std::vector<Node> methods;           ///< the mappings behind the names, as their task reads them
  std::vector<std::string> metrics;    ///< headline metrics; the task's own when the file names none
  std::vector<Expectation> expectations;
  RecordingWish recordings;
};

/// Reads one scenario file. Everything but the task's own keys is checked here; unknown keys are left
/// for `bench/run` to refuse once the task has read its own.
Result<Scenario> ParseScenario(std::string text, const std::string& file);

/// The keys that ParseScenario reads: known in every scenario, whatever its task.
const std::vector<std::string>& CommonScenarioKeys();

}  // namespace etude
