#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// Returns the files scenarios/choreography/moves/*.yaml, sorted by name; the build writes the function.
std::span<const EmbeddedText> BuiltinMoveFiles();
/// Returns the files scenarios/choreography/acts/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinActFiles();
/// Returns the files scenarios/choreography/songs/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinSongFiles();

}  // namespace etude
