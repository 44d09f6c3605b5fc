#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/run/run.h"
#include "bench/run/setup.h"

namespace etude {

/// Maps the names in `sources`, a scenario file and its included files, to the names that the manifest uses. A manifest
/// name is the path from the root of the repository (the nearest folder above the scenario with `.git`) or from
/// ShippedFolder; it is absolute if the scenario is in neither. These names are the same in every checkout and working
/// folder. With these names, relative `include` paths between the files still work.
std::map<std::string, std::string> CanonicalNames(const std::string& scenario_file,
                                                  const std::vector<std::string>& sources);

/// Returns the scenario files to which `paths` refer. A path is a file, a folder (its *.yaml files, sorted), or the
/// name of a shipped suite or scenario ("quick", "full/ik_weights").
Result<std::vector<std::string>> FindScenarioFiles(const std::vector<std::string>& paths);

/// Reads the scenarios that `options` names. The seed, trials and clips in `options` replace those of the scenarios.
/// Fails if two scenarios have the same name, or if there are more than kMaxCells cells.
Result<SuiteSetup> ReadSuite(const RunOptions& options);

/// Reads the suite from scenario files, or from the manifest `options.from`. Fails if that manifest describes scored
/// answers.
Result<SuiteSetup> ReadSuiteToRun(const RunOptions& options);

/// Prepares all scenarios (PrepareAll). If `options.from` names a manifest, fails if a clip has changed since that run,
/// or if the manifest names a program that may not be run.
Result<std::vector<PreparedScenario>> PrepareToRun(const SuiteSetup& suite, const RunOptions& options);

/// Fails if a scenario's task judges files. Such a task has no problems to export and no predictions to score.
Result<void> RefuseFiles(const SuiteSetup& suite);

}  // namespace etude
