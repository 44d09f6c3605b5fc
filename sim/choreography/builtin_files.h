#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// scenarios/choreography/moves/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinMoveFiles();
/// scenarios/choreography/acts/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinActFiles();
/// scenarios/choreography/songs/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinSongFiles();

}  // namespace etude
