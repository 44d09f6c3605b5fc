#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/run_data.h"
#include "bench/run/setup.h"
#include "bench/scenario/scenario.h"

namespace etude {

/// A scenario as a run has run it.
struct FinishedScenario {
  Scenario scenario;
  ScenarioSetup setup;
  std::vector<std::string> clip_digests;  ///< of the clips it had loaded, in order
};

/// A result folder, with all that a gate must know beside the rows.
struct FinishedRun {
  RunData data;
  std::vector<FinishedScenario> scenarios;
  /// Why it cannot be judged as a whole: it did not come to its end, or rows are missing. Empty = it is whole.
  std::vector<std::string> incomplete;
};

/// Reads a result folder with its scenarios and times. A run that is under way or was interrupted has no data,
/// only the reason. Fails like LoadRun, and when cells.jsonl holds a row twice or one that the manifest has not.
Result<FinishedRun> LoadFinishedRun(const std::filesystem::path& folder);

/// Checks `data.rows` against what the scenarios ask for, and notes what is missing. Fails on a row that is
/// there twice, or that no scenario asks for.
Result<void> CheckRows(FinishedRun& run, const Place& place);

}  // namespace etude
