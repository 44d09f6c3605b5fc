#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Returns the folder of what comes with the program: `share/etude` beside the `bin` of an installation, else the root
/// of the source tree that holds the program; empty if there is neither.
std::filesystem::path ShippedFolder();

/// Returns the names of all shipped scenario files, sorted: "full/ik_weights", "quick/ik".
std::vector<std::string> ShippedScenarios();

/// Returns the shipped file or folder for a name such as "full/ik_weights" or "quick"; empty if there is none.
std::filesystem::path FindShipped(const std::string& name);

/// Returns the error for a name that is no path and no shipped suite; it proposes the nearest shipped name.
tl::unexpected<Error> NotShipped(const std::string& path);

/// Returns the scenario file, or the folder of scenario files, for a path or shipped name. A local file or folder wins,
/// except a folder without scenarios. Empty if nothing is found.
std::filesystem::path FindScenario(const std::string& path);

/// Returns a note for each of `paths` that is both a local name and a shipped name; it says which of the two is used.
std::vector<Error> WhichIsMeant(const std::vector<std::string>& paths);

/// Copies a shipped scenario or suite into `folder`; returns the files. Fails if `name` is unknown or a file exists.
Result<std::vector<std::filesystem::path>> CopyShipped(const std::string& name, const std::filesystem::path& folder);

}  // namespace etude
