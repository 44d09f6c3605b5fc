#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Returns the folder with the files that come with the program: `share/etude` next to the `bin` of an installation,
/// else the root of the source tree that contains the program. The path is empty if neither folder exists.
std::filesystem::path ShippedFolder();

/// Returns the names of all shipped scenario files, sorted: "full/ik_weights", "quick/ik".
std::vector<std::string> ShippedScenarios();

/// Returns the path of the shipped file or folder with a name such as "full/ik_weights" or "quick"; an empty path if
/// there is none.
std::filesystem::path FindShipped(const std::string& name);

/// Returns the error for a name that is neither a path nor a shipped suite. The error proposes the shipped name that is
/// most similar.
tl::unexpected<Error> UnknownShippedName(const std::string& path);

/// Returns the scenario file, or the folder of scenario files, that a path or a shipped name denotes. A local file or
/// folder takes precedence, unless it is a folder without scenarios. The result is empty if nothing is found.
std::filesystem::path FindScenario(const std::string& path);

/// Returns a note for each of `paths` that is both a local path and a shipped name. The note says which of the two the
/// program uses.
std::vector<Error> DescribeAmbiguousPaths(const std::vector<std::string>& paths);

/// Copies a shipped scenario or suite into `folder` and returns the new files. Fails if `name` is unknown or if a file
/// exists.
Result<std::vector<std::filesystem::path>> CopyShipped(const std::string& name, const std::filesystem::path& folder);

}  // namespace etude
