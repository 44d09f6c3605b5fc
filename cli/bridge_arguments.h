#pragma once

#include "cli/arguments.h"

namespace etude {

/// Defines `etude bridge`.
void DefineBridge(CLI::App& app, Action& action);

}  // namespace etude
