#pragma once

#include "cli/arguments.h"

namespace etude {

/// Defines `etude train`.
void DefineTrain(CLI::App& app, Action& action);

}  // namespace etude
