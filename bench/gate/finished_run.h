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

/// Names (of conditions, methods or worlds), each with the digest of everything that its values depend on. If the
/// digests are equal, so are the values.
using NamedDigests = std::vector<std::pair<std::string, std::string>>;

struct FinishedScenario {
  Study study;
  std::uint64_t seed = 1;
  NamedDigests worlds;   ///< by condition (CompactLabel): the task's parameters and the clips
  NamedDigests methods;  ///< by method: its settings
  /// For a task that judges files: the name of each world and the digest of its truth, by trial. Empty for other tasks.
  NamedDigests files = {};
};

/// A result folder and everything else that a gate needs. bench/finished_runs reads it.
struct FinishedRun {
  RunData data;
  std::vector<FinishedScenario> scenarios;
  /// The reasons why there is no verdict: the run did not end, or rows are missing. Empty = the run is complete.
  std::vector<std::string> incomplete;
};

/// Returns the identities of all cells that a scenario requires, in canonical order.
std::vector<std::string> CellsOf(const Study& study);

/// Checks that the rows are the cells that the scenarios require. Missing rows are added to `incomplete`. Fails on a
/// duplicate row, and on a row that no scenario requires.
Result<void> CheckRows(FinishedRun& run, const Place& place);

/// The values of one metric, by trial; nullopt if a cell has none.
struct SnapshotValues {
  std::string metric;
  std::vector<std::optional<double>> values;
};

/// The statuses and values of one method under one condition, by trial.
struct SnapshotCells {
  std::string condition;  ///< the condition as text (CompactLabel)
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
  NamedDigests files = {};  ///< as FinishedScenario::files: name of each world and digest of its truth
};

/// The part of a run that is kept as a baseline. Later runs are compared with it world by world.
struct Snapshot {
  std::string suite;
  std::string program_version;
  std::vector<SnapshotScenario> scenarios;
  std::string unsealed = {};  ///< why its seal does not match, if it was read from a file; else ""
};

/// Returns the letter of a status: 'o' ok, 'u' unsolved, 'f' failed, 't' timeout, 'c' crashed, 'm' out of memory, 'b'
/// bad output, 's' skipped.
char StatusLetter(Status status);
/// Returns the status that a letter stands for; kFailed for an unknown letter.
Status StatusOf(char letter);

/// Returns the snapshot of a complete run. It contains the gated metrics only.
Snapshot TakeSnapshot(const FinishedRun& run);

}  // namespace etude
