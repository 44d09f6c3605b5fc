#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// A swept parameter and its value in one condition, both as the scenario wrote them.
struct Setting {
  std::string key;
  std::string value;
  bool operator==(const Setting&) const = default;
};

/// One line of cells.jsonl: a cell's identity and what came of it.
struct Row {
  std::string scenario;
  std::string task;
  std::vector<Setting> condition;  ///< empty when nothing is swept
  int trial = 0;
  std::string clip;  ///< "" for tasks without clips
  std::string method;
  CellResult result;  ///< `series` and `recording` live in files of their own

  /// "scenario/key=value,key=value/trial/method", unique in a run; a condition without sweep is "-".
  std::string Id() const;
};

/// A row's value of a metric; nothing when it is missing or was not measured.
std::optional<double> ValueOf(const Row& row, std::string_view metric);

/// For people: "key=value, key=value", or "" when nothing is swept.
std::string ConditionLabel(const std::vector<Setting>& condition);
/// For identities: "key=value,key=value", or "-".
std::string CompactLabel(const std::vector<Setting>& condition);

/// One metric of one method over the trials of one condition.
struct MetricSummary {
  std::string id;
  int present = 0;
  int missing = 0;  ///< cells without a value, whatever the reason
  std::optional<double> median, mean;
  std::optional<double> ci_low, ci_high;  ///< 95 % bootstrap interval of the metric's own aggregate (MetricInfo)
};

struct MethodSummary {
  std::string method;
  std::vector<std::pair<Status, int>> statuses;  ///< how many cells ended in each, zero ones left out
  std::vector<MetricSummary> metrics;
};

enum class Verdict { kBetter, kWorse, kNoDifference, kInconclusive };
std::string_view VerdictName(Verdict verdict);

/// `method` against `baseline` on the same worlds: the aggregate (MetricInfo: median, or mean for shares)
/// of the paired differences method − baseline.
struct Comparison {
  std::string metric;
  std::string baseline;
  std::string method;
  int pairs = 0;
  std::optional<double> difference, ci_low, ci_high;  ///< 95 % bootstrap, pairs resampled
  double share_better = 0;                            ///< of the pairs, ties count half
  Verdict verdict = Verdict::kInconclusive;
};

struct ConditionSummary {
  std::vector<Setting> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;  ///< every method against its baseline, headline metrics
};

enum class Outcome { kMet, kUnmet, kUndecided };
std::string_view OutcomeName(Outcome outcome);

/// What a scenario said it expects, and whether it came so.
struct ExpectationResult {
  std::string text;  ///< "orientation_error_deg of adaptive below fixed"
  Outcome outcome = Outcome::kUndecided;
  std::string detail;  ///< the figures that decided it
};

struct ScenarioSummary {
  std::string name;
  std::string task;
  std::string question;
  std::vector<std::string> methods;
  std::vector<std::string> headline_metrics;
  std::vector<ConditionSummary> conditions;
  std::vector<ExpectationResult> expectations;
};

struct CellSeries {
  std::string cell;  ///< Row::Id()
  std::vector<Series> series;
};

struct CellRecording {
  std::string cell;
  Recording recording;
};

/// A whole result folder in memory.
struct RunData {
  std::string suite;
  std::uint64_t seed = 1;
  std::string program_version;
  std::string command_line;  ///< from host.json
  std::string host;          ///< one line about the machine
  double wall_seconds = 0;
  std::vector<Row> rows;  ///< canonical order: scenario, condition, trial, method
  std::vector<ScenarioSummary> scenarios;
  std::vector<CellSeries> series;
  std::vector<CellRecording> recordings;
};

}  // namespace etude
