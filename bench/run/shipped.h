#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The folder of what comes with the program, scenarios and examples among it: `share/etude` beside the `bin` of an
/// installation, else the top of the source tree that the program was built in. Empty where neither is there.
std::filesystem::path ShippedFolder();

/// The names of all shipped scenario files, sorted: "full/ik_weights", "quick/ik".
std::vector<std::string> ShippedScenarios();

/// The shipped file or folder of a name such as "full/ik_weights" or "quick"; empty where there is none.
std::filesystem::path FindShipped(const std::string& name);

/// Says that nothing stands at a path and nothing is shipped under that name, with the nearest name that is.
tl::unexpected<Error> NotShipped(const std::string& path);

/// The scenario file, or the folder of them, that a path or a name means: what is here, else what is shipped. A folder
/// without a scenario does not stand in the way of what is shipped under its name. Empty where neither is there.
std::filesystem::path FindScenario(const std::string& path);

/// Says of those of `paths` that are here and are shipped under the same name, too, which of the two is meant.
std::vector<Error> WhichIsMeant(const std::vector<std::string>& paths);

/// Copies a shipped scenario or suite into `folder`; gives the files written. Fails when the name is not shipped or a
/// file is there already.
Result<std::vector<std::filesystem::path>> CopyShipped(const std::string& name, const std::filesystem::path& folder);

}  // namespace etude
