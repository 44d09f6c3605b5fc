#pragma once

#include "cli/arguments.h"

namespace etude {

/// Defines `etude sensor` and its subcommands.
void DefineSensor(CLI::App& app, Action& action);

}  // namespace etude
