#pragma once

#include <cstdint>
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
  /// Why it cannot be judged as a whole: it did not come to its end, or rows are missing. Empty = it is whole.
  std::vector<std::string> incomplete;
};

/// Checks `data.rows` against what the scenarios ask for, and notes what is missing. Fails on a row that is
/// there twice, or that no scenario asks for.
Result<void> CheckRows(FinishedRun& run, const Place& place);

}  // namespace etude
