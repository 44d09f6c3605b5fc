#include "engine/base/npy_head.h"

#include <fmt/ranges.h>

#include <cassert>

namespace etude {

std::string NpyHead(std::string_view type, std::span<const std::size_t> shape) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                 fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::string_view kFirstVersion("\x01\x00", 2);
  const std::size_t length = kNpyHead - kNpyMagic.size() - kFirstVersion.size() - 2;
  assert(text.size() < length);
  text.resize(length, ' ');
  text.back() = '\n';
  return std::string(kNpyMagic) + std::string(kFirstVersion) + static_cast<char>(length & 0xff) +
         static_cast<char>(length >> 8) + text;
}

}  // namespace etude
