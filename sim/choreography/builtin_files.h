#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/embedded_text.h"

namespace etude {

/// scenarios/choreography/moves/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinMoveFiles();
/// scenarios/choreography/acts/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinActFiles();
/// scenarios/choreography/songs/*.yaml, likewise.
std::span<const EmbeddedText> BuiltinSongFiles();

/// What the files are called without ".yaml", in their order.
std::vector<std::string> NamesOf(std::span<const EmbeddedText> files);
/// The file "<name>.yaml", or null.
const EmbeddedText* FindFile(std::span<const EmbeddedText> files, std::string_view name);

}  // namespace etude
