#include "engine/base/utf8.h"

#include <cstdint>

namespace etude {
namespace {

std::uint8_t ByteAt(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// Returns how many bytes the character at `at` has (RFC 3629, section 4); 0 when no character begins there.
std::size_t LengthAt(std::string_view text, std::size_t at) {
  const std::uint8_t first = ByteAt(text, at), second = ByteAt(text, at + 1);
  const auto follows = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if ((ByteAt(text, at + i) & 0xc0) != 0x80) return false;
    }
    return true;
  };
  if (first < 0x80) return first == 0 ? 0 : 1;
  if (first >= 0xc2 && first <= 0xdf) return follows(1, 2) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    const bool is_overlong = first == 0xe0 && second < 0xa0, is_surrogate = first == 0xed && second > 0x9f;
    return !is_overlong && !is_surrogate && follows(1, 3) ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool is_overlong = first == 0xf0 && second < 0x90, is_beyond = first == 0xf4 && second > 0x8f;
    return !is_overlong && !is_beyond && follows(1, 4) ? 4 : 0;
  }
  return 0;
}

}  // namespace

Result<void> CheckUtf8(std::string_view text, const std::string& file) {
  int line = 1, column = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = LengthAt(text, at);
    if (length == 0)
      return Fail({file, line, column}, "byte 0x{:02x} is no UTF-8 text; save it as UTF-8", ByteAt(text, at));
    column = text[at] == '\n' ? 1 : column + 1;
    line += text[at] == '\n' ? 1 : 0;
    at += length;
  }
  return {};
}

}  // namespace etude
