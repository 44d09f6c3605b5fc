#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Returns the settings (NAME=VALUE) with which one build gives the same bytes on every machine. The settings must
/// exist before the process starts, so commands that compute restart themselves (cli/main.cc).
const std::vector<std::string>& PinnedEnvironment();

/// The variable with the key of secret worlds (bench/run/secret_key.h). The variable is never passed to child
/// processes.
inline constexpr const char* kKeyVariable = "ETUDE_SEED_KEY";

/// Returns the names of the variables that are passed on unchanged: folders, the user, the terminal, GL and sanitizers.
/// None of them affects a result except ETUDE_GL, which the manifest records.
const std::vector<std::string>& PassedVariables();

/// Returns the complete environment of every process that computes, outside methods included: the pinned settings and
/// the passed variables. No other variable of the user's shell can change a result.
std::vector<std::string> ClosedEnvironment();

/// Restarts this command (exec) in the closed environment. Returns without restarting if the environment is closed
/// already. Fails if the restart fails.
Result<void> EnterPinnedEnvironment();

/// Returns the loaded shared libraries, sorted by name: "libOSMesa.so.8", and the build ID in hexadecimal ("" = none).
/// Build IDs differ between any two builds.
std::vector<std::pair<std::string, std::string>> LoadedLibraries();

}  // namespace etude
