#pragma once

#include <string_view>

namespace etude {

/// A text file compiled into the program (cmake/embed_texts.cmake), so that tests, workers and installed programs all
/// find it.
struct EmbeddedText {
  std::string_view name;  ///< file name, such as "clap.yaml"
  std::string_view text;
};

/// Returns the file's name without its extension, such as "clap", as users write it.
inline std::string_view StemOf(const EmbeddedText& file) { return file.name.substr(0, file.name.rfind('.')); }

}  // namespace etude
