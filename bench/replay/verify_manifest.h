#pragma once

#include <span>
#include <vector>

#include "bench/finished_runs/finished_runs.h"
#include "bench/replay/verify.h"

namespace etude {

/// Returns the scenarios that the manifest of a run's folder describes, without their clips.
Result<std::vector<Scenario>> ScenariosOf(const FilePath& folder);

/// Compares the manifest with the one that a run of these scenarios would write, except for what describes the machine.
/// Without `scenarios`, the descriptions of clips are not checked either.
Result<Verified> VerifyManifest(const FilePath& folder, const FinishedRun& run, const SuiteSetup& suite,
                                std::span<const PreparedScenario> scenarios);

/// Checks keys and kinds of host.json. Its values describe a machine that is not here.
Result<Verified> VerifyHost(const FilePath& folder);

}  // namespace etude
