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

/// Collects what a gate must know of a scenario that has been run. `clip_digests`: of the clips it had loaded, in
/// order. What worlds are digests of leaves out all that does not shape them (questions, expectations, gate rules,
/// comments), so that editing those keeps a baseline valid.
FinishedScenario FinishScenario(const Scenario& scenario, const ScenarioSetup& setup,
                                std::span<const std::string> clip_digests);

/// A scenario ready to be run under any seed, in this process and without a folder: what the gate's test of itself
/// does hundreds of times. A method that crashes takes the program with it.
struct Rehearsal {
  SourceTexts sources;
  ScenarioSetup setup;
  Scenario scenario;
};

/// Reads the first scenario of a file; "" = a small one of task ik that is built in. `trials` replaces its own.
Result<Rehearsal> ReadRehearsal(const std::string& file, std::optional<int> trials);

/// Runs all its cells under `seed`.
Result<FinishedRun> RunInProcess(const Rehearsal& rehearsal, std::uint64_t seed);

/// Reads a result folder with its scenarios and times. A run that is under way or was interrupted has no data,
/// only the reason. Fails like LoadRun, and when cells.jsonl holds a row twice or one that the manifest has not.
Result<FinishedRun> LoadFinishedRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

}  // namespace etude
