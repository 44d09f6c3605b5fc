#pragma once

#include <span>
#include <vector>

#include "bench/finished_runs/finished_runs.h"
#include "bench/replay/verify.h"

namespace etude {

/// Returns the scenarios that the manifest in a run's folder describes. Their clips are not loaded.
Result<std::vector<Scenario>> ScenariosOf(const FilePath& folder);

/// Compares the manifest with the manifest that a run of these scenarios would write, apart from the description of the
/// machine. If `scenarios` is empty, the descriptions of clips are not compared either. `programs` is the JSON to which
/// AddPrograms has added the outside programs as they are now; if it is null, programs are not compared.
Result<Verified> VerifyManifest(const FilePath& folder, const FinishedRun& run, const SuiteSetup& suite,
                                std::span<const PreparedScenario> scenarios, const Json& programs);

/// Checks the keys of host.json and the types of their values. The values describe another machine and cannot be
/// checked.
Result<Verified> VerifyHost(const FilePath& folder);

}  // namespace etude
