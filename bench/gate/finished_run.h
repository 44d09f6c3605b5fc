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

/// A name with what its values depend on: when that differs, so does what the name stands for.
using NamedDigests = std::vector<std::pair<std::string, std::string>>;

/// A scenario as a run has run it.
struct FinishedScenario {
  Study study;
  std::uint64_t seed = 1;
  NamedDigests worlds;   ///< by condition (CompactLabel): the task's parameters and the clips
  NamedDigests methods;  ///< by method: its settings
};

/// A result folder, with all that a gate must know beside the rows (made by bench/finished_runs).
struct FinishedRun {
  RunData data;
  std::vector<FinishedScenario> scenarios;
  /// The reason why it cannot be judged as a whole: it did not end, or rows are missing. Empty = it is whole.
  std::vector<std::string> incomplete;
};

/// The identities of all cells that a scenario asks for, in canonical order.
std::vector<std::string> CellsOf(const Study& study);

/// Checks `data.rows` against what the scenarios ask for, and notes what is missing. Fails on a row that is
/// there twice, or that no scenario asks for.
Result<void> CheckRows(FinishedRun& run, const Place& place);

/// The values of one metric, by trial; nothing where a cell has none.
struct SnapshotValues {
  std::string metric;
  std::vector<std::optional<double>> values;
};

/// The statuses and values of one method under one condition, trial by trial.
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
};

/// The part of a run that is kept so that another can be compared with it, world by world: a baseline.
struct Snapshot {
  std::string suite;
  std::string program_version;
  std::vector<SnapshotScenario> scenarios;
  std::string unsealed = {};  ///< of one that was read: why its seal does not vouch for it; else ""
};

/// 'o' ok, 'u' unsolved, 'f' failed, 't' timeout, 'c' crashed, 'm' out of memory, 'b' bad output, 's' skipped.
char StatusLetter(Status status);
/// The status of a letter; kFailed of any that is none.
Status StatusOf(char letter);

/// Takes the gated metrics of a whole run.
Snapshot TakeSnapshot(const FinishedRun& run);

}  // namespace etude
