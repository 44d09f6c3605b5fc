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

/// Names of conditions, methods or worlds, each with the digest of the keys and files that determine it. If two runs
/// have the same seed and equal digests, only a change of the software can make their values differ.
using NamedDigests = std::vector<std::pair<std::string, std::string>>;

struct FinishedScenario {
  Study study;
  std::uint64_t seed = 1;
  NamedDigests worlds;   ///< by condition (CompactLabel): digest of the task's parameters and the clips
  NamedDigests methods;  ///< by method: digest of the method's settings
  /// For a task that judges files: the name of each world and the digest of its ground truth, by trial. Empty for other
  /// tasks.
  NamedDigests files = {};
};

/// The contents of a result folder that a gate needs. bench/finished_runs reads them.
struct FinishedRun {
  RunData data;
  std::vector<FinishedScenario> scenarios;
  /// The reasons why the gate gives no verdict: the run did not end, or rows are missing. Empty if the run is complete.
  std::vector<std::string> incomplete;
};

/// Returns the identities of all cells that a scenario requires, in canonical order: condition, trial, method.
std::vector<std::string> CellsOf(const Study& study);

/// Checks that the run has one row for each cell that the scenarios require, and no other rows. Fails on a duplicate
/// row and on a row that no scenario requires; adds missing rows to `run.incomplete`. If the run has more than
/// 100,000 rows, fails also on a missing row and on rows that are not in canonical order.
Result<void> CheckRows(FinishedRun& run, const Place& place);

/// The values of one metric, by trial; nullopt if the cell of a trial has no value.
struct SnapshotValues {
  std::string metric;
  std::vector<std::optional<double>> values;
};

/// The statuses and values of one method under one condition, by trial.
struct SnapshotCells {
  std::string condition;  ///< the condition as text (CompactLabel)
  std::string method;
  std::string statuses;                 ///< one letter per trial (StatusLetter)
  std::vector<SnapshotValues> metrics;  ///< values of each metric, in the order of SnapshotScenario::metrics
  std::vector<JudgedOn> judged = {};    ///< what each trial's cell was judged on; empty if no cell states it
};

struct SnapshotScenario {
  std::string name;
  std::uint64_t seed = 1;
  int trials = 1;
  NamedDigests worlds;                               ///< by condition: digest of the task's parameters and the clips
  NamedDigests methods;                              ///< by method: digest of the method's settings
  std::vector<std::pair<std::string, int>> metrics;  ///< the metrics in the snapshot, with their versions
  std::vector<SnapshotCells> cells;                  ///< one entry for each condition and method
  NamedDigests files = {};  ///< as in FinishedScenario::files: name of each world and digest of its ground truth
};

/// The part of a run that a baseline file stores. Later runs are compared with it world by world.
struct Snapshot {
  std::string suite;
  std::string program_version;
  std::vector<SnapshotScenario> scenarios;
  std::string unsealed = {};  ///< why the file's seal does not match; "" = it matches, or no file was read
};

/// Returns the letter of a status: 'o' ok, 'u' unsolved, 'f' failed, 't' timeout, 'c' crashed, 'm' out of memory, 'b'
/// bad output, 's' skipped.
char StatusLetter(Status status);
/// Returns the status that a letter stands for; kFailed for an unknown letter.
Status StatusOf(char letter);

/// Returns the snapshot of a complete run. The snapshot contains only the metrics that the gate compares.
Snapshot TakeSnapshot(const FinishedRun& run);

}  // namespace etude
