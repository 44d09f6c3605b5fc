#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Writes a word of a command line, in quotes when a shell would take it apart.
std::string ShellWord(std::string_view text);

}  // namespace etude
