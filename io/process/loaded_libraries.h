#pragma once

#include <string>
#include <utility>
#include <vector>

namespace etude {

/// Returns the loaded shared libraries, sorted by name: "libOSMesa.so.8", and the build ID in hexadecimal ("" = none).
/// Build IDs differ between any two builds.
std::vector<std::pair<std::string, std::string>> LoadedLibraries();

}  // namespace etude
