#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// Returns the files scenarios/choreography/moves/*.yaml, sorted by name. The build generates these functions.
std::span<const EmbeddedText> BuiltinMoveFiles();
/// Returns the files scenarios/choreography/acts/*.yaml, sorted by name.
std::span<const EmbeddedText> BuiltinActFiles();
/// Returns the files scenarios/choreography/songs/*.yaml, sorted by name.
std::span<const EmbeddedText> BuiltinSongFiles();

}  // namespace etude
