#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The settings under which the same build gives the same bytes on any machine, as NAME=VALUE. They must stand before a
/// process starts, which is why commands that compute start themselves anew (cli/main.cc).
const std::vector<std::string>& PinnedEnvironment();

/// The variable that may hold the key of secret worlds (bench/run/secret_key.h). No child is given it.
inline constexpr const char* kKeyVariable = "ETUDE_SEED_KEY";

/// The names of what may come from outside: where programs, homes and temporary files are, who asks, the terminal, how
/// GL is reached, and what sanitizers are told. Nothing of these reaches a result, but for GL's, which the manifest
/// tells.
const std::vector<std::string>& PassedVariables();

/// The whole environment of everything that computes, methods outside included: the pinned settings, and of ours what
/// may pass. Built from these lists, so that no variable of somebody's shell decides about a pixel.
std::vector<std::string> ClosedEnvironment();

/// Starts this very command anew in the closed environment, unless it is in there already. Returns only when it is, or
/// when that fails.
Result<void> EnterPinnedEnvironment();

/// The shared libraries that are loaded now, sorted by name: "libOSMesa.so.8" and its build ID in hexadecimal, which
/// tells any two builds of it apart ("" where it has none).
std::vector<std::pair<std::string, std::string>> LoadedLibraries();

}  // namespace etude
