#pragma once

#include "cli/arguments.h"
#include "cli/clip_commands.h"

namespace etude {

/// --joint-map, --unit and --up, of every command that opens clips by themselves.
void AddClipReading(CLI::App& command, ClipReading& reading);

/// Defines `etude clip` and its subcommands.
void DefineClip(CLI::App& app, Action& action);

}  // namespace etude
