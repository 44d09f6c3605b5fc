#pragma once

#include <string_view>

namespace etude {

/// The key of a task that takes a file of taught moves (etude teach). Whoever makes the task opens it, and gives its
/// text in TaskInput::texts.
constexpr const char* kMovesKey = "moves";

/// Whether a reference names a file: it can name nothing else.
constexpr bool IsMovesFile(std::string_view reference) { return !reference.empty(); }

}  // namespace etude
