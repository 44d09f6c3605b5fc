#pragma once

#include <string>
#include <utility>
#include <vector>

namespace etude {

/// The shared libraries that are loaded now, sorted by name: "libOSMesa.so.8" and its build ID in hexadecimal, which
/// tells any two builds of it apart ("" where it has none).
std::vector<std::pair<std::string, std::string>> LoadedLibraries();

}  // namespace etude
