#pragma once

#include <string>
#include <vector>

namespace etude {

/// Returns the settings (NAME=VALUE) with which one build gives the same bytes on every machine. The settings must
/// exist before the process starts, so the program `etude` (cli/launcher.cc) sets them and starts the real program.
const std::vector<std::string>& PinnedEnvironment();

/// The variable with the key of secret worlds (bench/run/secret_key.h). Only the launcher passes it on.
inline constexpr const char* kKeyVariable = "ETUDE_SEED_KEY";

/// Returns the complete environment of every process that computes, outside methods included: the pinned settings, and
/// the user's variables for folders, the user, the terminal, GL and sanitizers. None of these variables affects a
/// result except ETUDE_GL, which the manifest records. No other variable of the user's shell can change a result.
std::vector<std::string> ClosedEnvironment();

/// Returns "" if this process has the closed environment, and perhaps the key of secret worlds. Otherwise returns the
/// first setting that is missing, or the name of the first variable that does not belong to it.
std::string FirstDifferenceFromClosed();

/// Lets Mesa use all abilities of this machine's processor and its cache of shaders, for pages and films, whose bytes
/// need not be the same on every machine. Call it before the first picture is drawn.
void DrawAsFastAsPossible();

}  // namespace etude
