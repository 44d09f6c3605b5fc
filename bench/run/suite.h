#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/run/run.h"
#include "bench/run/setup.h"

namespace etude {

/// The manifest's names of scenario files and those that they include, by the names in `sources`: the path from the top
/// of the repository that holds the scenario (the nearest folder above it with `.git`) or of ShippedFolder, absolute
/// where neither holds it.
/// These names are the same wherever a run was started from, and in every checkout. Names stay such that includes find
/// each other.
std::map<std::string, std::string> CanonicalNames(const std::string& scenario_file,
                                                  const std::vector<std::string>& sources);

/// The scenario files behind paths: a file is itself, a folder its *.yaml, sorted by name; what is neither may be the
/// name of a suite or a scenario that is shipped ("quick", "full/ik_weights").
Result<std::vector<std::string>> FindScenarioFiles(const std::vector<std::string>& paths);

/// Reads the scenarios that `options` names, with its seed, trials and clips put in place of theirs.
/// Refuses two scenarios of one name, and more cells than can be held in memory.
Result<SuiteSetup> ReadSuite(const RunOptions& options);

/// The suite to be run: of scenarios, or of the manifest that `options.from` names. Refuses one of scored answers.
Result<SuiteSetup> ReadSuiteToRun(const RunOptions& options);

/// PrepareAll; refuses clips that have changed since a manifest was written.
Result<std::vector<PreparedScenario>> PrepareToRun(const SuiteSetup& suite, const RunOptions& options);

}  // namespace etude
