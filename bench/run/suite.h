#pragma once

#include <string>
#include <vector>

#include "bench/run/run.h"
#include "bench/run/setup.h"

namespace etude {

/// The scenario files behind paths: a file is itself, a folder its *.yaml, sorted by name.
Result<std::vector<std::string>> FindScenarioFiles(const std::vector<std::string>& paths);

/// Reads the scenarios that `options` names, with its seed, trials and clips put in place of theirs.
/// Refuses two scenarios of one name, and more cells than can be held in memory.
Result<SuiteSetup> ReadSuite(const RunOptions& options);

/// The suite to be run: of scenarios, or of the manifest that `options.from` names. Refuses one of scored answers.
Result<SuiteSetup> ReadSuiteToRun(const RunOptions& options);

/// PrepareAll; refuses clips that have changed since a manifest was written.
Result<std::vector<PreparedScenario>> PrepareToRun(const SuiteSetup& suite, const RunOptions& options);

}  // namespace etude
