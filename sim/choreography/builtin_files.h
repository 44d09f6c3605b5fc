#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// scenarios/choreography/moves/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinMoveFiles();

}  // namespace etude
