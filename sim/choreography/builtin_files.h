#pragma once

#include <span>
#include <string_view>

namespace etude {

/// A text file compiled into the program.
struct EmbeddedText {
  std::string_view name;  ///< "clap.yaml"
  std::string_view text;
};

/// scenarios/choreography/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinMoveFiles();

}  // namespace etude
