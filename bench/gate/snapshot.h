#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/gate/finished_run.h"

namespace etude {

/// The values of one metric, by trial; nothing where a cell has none.
struct SnapshotValues {
  std::string metric;
  std::vector<std::optional<double>> values;
};

/// What one method came to under one condition, trial by trial.
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

/// What is kept of a run so that another can be compared with it, world by world: a baseline.
struct Snapshot {
  std::string suite;
  std::string program_version;
  std::vector<SnapshotScenario> scenarios;
};

/// 'o' ok, 'u' unsolved, 'f' failed, 't' timeout, 'c' crashed, 'm' out of memory, 'b' bad output, 's' skipped.
char StatusLetter(Status status);
/// The status of a letter; kFailed of any that is none.
Status StatusOf(char letter);
/// Whether a cell of this letter ended as it did because of the machine (timeout, crashed, out of memory): its
/// row says nothing about the method that another run could repeat.
bool DependsOnMachine(char letter);

/// Takes the gated metrics of a whole run.
Snapshot TakeSnapshot(const FinishedRun& run);

}  // namespace etude
