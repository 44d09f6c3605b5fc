#include "engine/formats/gltf/text.h"

#include <algorithm>

namespace etude {
namespace {

/// Returns how many bytes the UTF-8 character at the start of `text` has; 0 when there is none (RFC 3629), or one that
/// would break a line or command a terminal.
std::size_t CharacterBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  const bool is_control = first < 0x20 || first == 0x7F || (first == 0xC2 && byte(1) < 0xA0);
  if (is_control) return 0;
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0 ? 2 : (first >= 0xE0 && first < 0xF0 ? 3 : 4);
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  const unsigned second = byte(1);
  const bool is_overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool is_beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return is_overlong || is_beyond ? 0 : length;
}

}  // namespace

std::string GltfText(std::string_view name) {
  std::string text;
  while (!name.empty()) {
    const std::size_t length = CharacterBytes(name);
    text += length == 0 ? "?" : name.substr(0, length);
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

}  // namespace etude
