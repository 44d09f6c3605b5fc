#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/base/image.h"

namespace etude {

/// A run of pixels in a picture, and the chromas (change_detection.h) of the background at the same pixels. Grey counts
/// as pure red.
struct HueBlock {
  const Rgb8* pixels = nullptr;
  const std::int16_t* background_x = nullptr;
  const std::int16_t* background_y = nullptr;
  std::size_t count = 0;
};

struct HueBlockResult {
  std::size_t compared = 0;  ///< number of compared pixels, counted from the first; only whole vectors are compared
  bool is_sure = true;       ///< false if rounding may have decided a comparison
};

/// Writes to `out`, for each pixel, 1 if the hues of picture and background differ by more than a threshold angle,
/// otherwise 0. `cosine2` is the squared cosine of that angle. Uses SIMD in single precision. Dot products of chromas
/// are integers below 2²⁴ and exact; only the squares of the products are rounded.
HueBlockResult CompareHueBlock(const HueBlock& block, float cosine2, std::uint8_t* out);

}  // namespace etude
