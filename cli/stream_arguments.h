#pragma once

#include "cli/arguments.h"

namespace etude {

/// Defines `etude teach` and `etude recognise`.
void DefineTeach(CLI::App& app, Action& action);
void DefineRecognise(CLI::App& app, Action& action);

}  // namespace etude
