#pragma once

#include <map>
#include <string>
#include <vector>

namespace etude {

/// What a manifest calls scenario files and those that they include, by the names in `sources`: the path from the top
/// of the repository that holds the scenario (the nearest folder above it with `.git`), absolute where there is none.
/// The same wherever a run was started from, and in every checkout. Names stay such that includes find each other.
std::map<std::string, std::string> CanonicalNames(const std::string& scenario_file,
                                                  const std::vector<std::string>& sources);

}  // namespace etude
