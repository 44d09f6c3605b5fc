#include "engine/base/utf8.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace etude {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// Returns the allowed range of the byte after `first`, the first byte of a character with several bytes. The range is
/// narrower where an overlong form, a surrogate or a character beyond U+10FFFF would follow (RFC 3629, section 4).
std::pair<std::uint8_t, std::uint8_t> SecondByteAfter(std::uint8_t first) {
  if (first == 0xe0) return {0xa0, 0xbf};
  if (first == 0xed) return {0x80, 0x9f};
  if (first == 0xf0) return {0x90, 0xbf};
  if (first == 0xf4) return {0x80, 0x8f};
  return {0x80, 0xbf};
}

}  // namespace

Utf8Character FirstCharacter(std::string_view text) {
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(text[at]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return {first, 1};
  if (first < 0xc2 || first > 0xf4) return {};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (text.size() < length) return {};
  const auto [least, most] = SecondByteAfter(first);
  if (byte(1) < least || byte(1) > most) return {};
  char32_t code = first & (0xffU >> (length + 1));
  for (std::size_t at = 1; at < length; ++at) {
    if ((byte(at) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(at) & 0x3fU);
  }
  return {code, length};
}

std::string_view WithoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

Result<void> CheckUtf8(std::string_view text, const std::string& file) {
  int line = 1, column = 1;
  while (!text.empty()) {
    const auto [code, length] = FirstCharacter(text);
    if (length == 0 || code == 0) {
      return Fail({file, line, column}, "byte 0x{:02x} is not UTF-8 text; save the file as UTF-8",
                  static_cast<std::uint8_t>(text.front()));
    }
    column = code == '\n' ? 1 : column + 1;
    line += code == '\n' ? 1 : 0;
    text.remove_prefix(length);
  }
  return {};
}

bool IsHidden(char32_t code) {
  // Unicode's categories Cc, Zl and Zp beyond ASCII, and the characters with Unicode's property
  // Default_Ignorable_Code_Point.
  using Range = std::pair<char32_t, char32_t>;
  constexpr auto kHidden = std::to_array<Range>({{0x80, 0x9f},
                                                 {0xad, 0xad},
                                                 {0x34f, 0x34f},
                                                 {0x61c, 0x61c},
                                                 {0x115f, 0x1160},
                                                 {0x17b4, 0x17b5},
                                                 {0x180b, 0x180f},
                                                 {0x200b, 0x200f},
                                                 {0x2028, 0x202e},
                                                 {0x2060, 0x206f},
                                                 {0x3164, 0x3164},
                                                 {0xfe00, 0xfe0f},
                                                 {0xfeff, 0xfeff},
                                                 {0xffa0, 0xffa0},
                                                 {0xfff0, 0xfffb},
                                                 {0x1bca0, 0x1bca3},
                                                 {0x1d173, 0x1d17a},
                                                 {0xe0000, 0xe0fff}});
  return std::ranges::any_of(kHidden, [&](auto range) { return range.first <= code && code <= range.second; });
}

std::string NumberOf(char32_t code) { return fmt::format("[U+{:04X}]", static_cast<std::uint32_t>(code)); }

std::string Visible(std::string_view text, std::string_view kept) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const auto [code, length] = FirstCharacter(text);
    const std::string_view bytes = text.substr(0, length);
    if (length == 0) {
      shown += kReplacement;
    } else if ((code < ' ' || code == 0x7f) && kept.find(bytes) == std::string_view::npos) {
      shown += ' ';
    } else if (IsHidden(code)) {
      shown += NumberOf(code);
    } else {
      shown += bytes;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return shown;
}

}  // namespace etude
