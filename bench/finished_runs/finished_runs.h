#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "bench/gate/finished_run.h"
#include "bench/results/folder.h"
#include "bench/run/setup.h"
#include "bench/scenario/scenario.h"

namespace etude {

/// Collects what a gate needs to know about a scenario that has been run. `clip_digests` are the digests of the
/// loaded clips, in order. A condition's digest covers only the task, the task's own keys and the clips. A baseline
/// therefore stays valid if questions, expectations, gate rules or comments are edited.
FinishedScenario FinishScenario(const Scenario& scenario, const ScenarioSetup& setup,
                                std::span<const std::string> clip_digests);

/// A scenario that can be run under any seed, in this process and without a result folder. The gate's self-test runs it
/// hundreds of times. A method that crashes ends the program.
struct Rehearsal {
  SourceTexts sources;
  ScenarioSetup setup;
  Scenario scenario;
};

/// Reads the first scenario of `file`; "" = a small built-in scenario of task ik. `trials` replaces the scenario's own
/// number of trials.
Result<Rehearsal> ReadRehearsal(const std::string& file, std::optional<int> trials);

/// Runs all cells of the rehearsal under `seed`.
Result<FinishedRun> RunInProcess(const Rehearsal& rehearsal, std::uint64_t seed);

/// The part of a run that is held in memory.
enum class LoadedPart {
  kAll,      ///< everything that LoadRun loads
  kOutline,  ///< what LoadRunRowByRow loads
};

/// Reads a result folder with its scenarios and times. A run that has not ended or was interrupted has no data, only
/// the reason (`incomplete`). Fails as LoadRun and CheckRows do. Fails also if this program has another version of a
/// metric than the manifest, or if a rule on processor times needs times that the run does not have.
Result<FinishedRun> LoadFinishedRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired,
                                    LoadedPart part = LoadedPart::kAll);

}  // namespace etude
