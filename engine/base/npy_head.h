#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace etude {

/// The magic string at the beginning of every .npy file (NumPy's format).
inline constexpr std::string_view kNpyMagic = "\x93NUMPY";
/// Size of the head in bytes: a multiple of 64, large enough for any shape.
inline constexpr std::size_t kNpyHead = 192;

/// Writes the first kNpyHead bytes of an .npy file of version 1.0: magic string, length of the dictionary, and a Python
/// dictionary padded with spaces. `type` is NumPy's name of the type, such as "<f8".
std::string NpyHead(std::string_view type, std::span<const std::size_t> shape);

}  // namespace etude
