#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A character and its number of bytes in UTF-8 (RFC 3629: no surrogates, no overlong forms, up to U+10FFFF). The
/// length is 0 if the bytes are not valid UTF-8.
struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// Decodes the first character of `text`, which must not be empty.
Utf8Character FirstCharacter(std::string_view text);

/// Returns the text without the byte order mark, which Windows programs write at the beginning of UTF-8 text.
std::string_view WithoutByteOrderMark(std::string_view text);

/// Fails for text that is not UTF-8 or contains a zero byte, with the position of the first wrong byte.
Result<void> CheckUtf8(std::string_view text, const std::string& file);

/// Returns true for characters that a reader does not see: those that change the direction of writing, have no width,
/// or control a terminal (U+0080 to U+009F). ASCII control characters are not included.
bool IsHidden(char32_t code);

/// Returns the text that is shown instead of a hidden character: its number, "[U+202E]".
std::string NumberOf(char32_t code);

/// Makes text safe to show: a hidden character becomes its number, a control character becomes a space unless it is in
/// `kept`, a byte that is not valid UTF-8 becomes U+FFFD. So a hostile name can neither control a terminal nor look
/// like another name.
std::string Visible(std::string_view text, std::string_view kept = "");

}  // namespace etude
