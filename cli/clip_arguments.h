#pragma once

#include "cli/arguments.h"

namespace etude {

/// Defines `etude clip` and its subcommands.
void DefineClip(CLI::App& app, Action& action);

}  // namespace etude
