#pragma once

#include <optional>
#include <string>

#include "bench/gate/finished_run.h"
#include "bench/run/setup.h"

namespace etude {

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

}  // namespace etude
