#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A character and how many bytes of UTF-8 it has (RFC 3629: no surrogates, no overlong forms, up to U+10FFFF); 0 where
/// the bytes are no UTF-8.
struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// Reads the character that a text, which is not empty, begins with.
Utf8Character FirstCharacter(std::string_view text);

/// Refuses text that is not UTF-8, or holds a zero byte, with the place of the first byte that is wrong.
Result<void> CheckUtf8(std::string_view text, const std::string& file);

/// True of what a reader does not see: characters that turn the direction of writing, take no place, or command a
/// terminal beyond ASCII (U+0080 to U+009F). ASCII's own control characters are not among them.
bool IsHidden(char32_t code);

/// The number of a character, "[U+202E]", to stand in its place.
std::string NumberOf(char32_t code);

/// Makes text safe to be shown: a hidden character becomes its number, a control character a space but for those of
/// `kept`, a byte that is no UTF-8 becomes U+FFFD. A hostile name can neither command a terminal nor read as another.
std::string Visible(std::string_view text, std::string_view kept = "");

}  // namespace etude
