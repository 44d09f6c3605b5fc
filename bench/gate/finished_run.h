#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/study.h"
#include "engine/base/result.h"

namespace etude {

/// A name with the digest of what its values depend on: if the digest differs, so do the values.
using NamedDigests = std::vector<std::pair<std::string, std::string>>;

struct FinishedScenario {
  Study study;
  std::uint64_t seed = 1;
  NamedDigests worlds;   ///< by condition (CompactLabel): the task's parameters and the clips
  NamedDigests methods;  ///< by method: its settings
  /// For a task that judges files, by trial: the name of the world and the digest of its truth. Empty for other tasks.
  NamedDigests files = {};
};

/// A result folder and all else that a gate needs; bench/finished_runs reads it.
struct FinishedRun {
  RunData data;
  std::vector<FinishedScenario> scenarios;
  /// The reasons why there is no verdict: the run did not end, or rows are missing. Empty = it is complete.
  std::vector<std::string> incomplete;
};

/// Returns the identities of all cells that a scenario requires, in canonical order.
std::vector<std::string> CellsOf(const Study& study);

/// Checks the rows against the cells that the scenarios require. Missing rows go into `incomplete`; a duplicate row,
/// and one that no scenario requires, are failures.
Result<void> CheckRows(FinishedRun& run, const Place& place);

/// The values of one metric, by trial; nullopt if a cell has none.
struct SnapshotValues {
  std::string metric;
  std::vector<std::optional<double>> values;
};

/// The statuses and values of one method under one condition, by trial.
struct SnapshotCells {
  std::string condition;  ///< CompactLabel
  std::string method;
  std::string statuses;                 ///< one letter per trial (StatusLetter)
  std::vector<SnapshotValues> metrics;  ///< in the order of SnapshotScenario::metrics
};

struct SnapshotScenario {
  std::string name;
  std::uint64_t seed = 1;
  int trials = 1;
  NamedDigests worlds;                               ///< by condition: the task's parameters and the clips
  NamedDigests methods;                              ///< by method: its settings
  std::vector<std::pair<std::string, int>> metrics;  ///< the metrics kept, with their versions
  std::vector<SnapshotCells> cells;                  ///< conditions × methods
  NamedDigests files = {};                           ///< FinishedScenario::files
};

/// The part of a run that is kept as a baseline, so that later runs can be compared with it world by world.
struct Snapshot {
  std::string suite;
  std::string program_version;
  std::vector<SnapshotScenario> scenarios;
  std::string unsealed = {};  ///< why its seal does not match, if it was read from a file; else ""
};

/// 'o' ok, 'u' unsolved, 'f' failed, 't' timeout, 'c' crashed, 'm' out of memory, 'b' bad output, 's' skipped.
char StatusLetter(Status status);
/// Returns the status of a letter; kFailed for an unknown one.
Status StatusOf(char letter);

/// Returns the snapshot of a complete run: its gated metrics.
Snapshot TakeSnapshot(const FinishedRun& run);

}  // namespace etude
