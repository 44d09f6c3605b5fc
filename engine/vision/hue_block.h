#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/base/image.h"

namespace etude {

/// Some neighbouring pixels of a picture, and the chromas (change_detection.h) of the same pixels of the background;
/// grey ones count as pure red.
struct HueBlock {
  const Rgb8* pixels = nullptr;
  const std::int16_t* background_x = nullptr;
  const std::int16_t* background_y = nullptr;
  std::size_t count = 0;
};

struct HueBlockResult {
  std::size_t compared = 0;  ///< number of compared pixels, from the first on: whole vectors
  bool is_sure = true;       ///< false if rounding may have decided about one of them
};

/// Writes 1 to `out` if the hues differ by more than the angle with the squared cosine `cosine2`, else 0, by SIMD in
/// single precision. Dot products of chromas are integers below 2²⁴, so only their squares are rounded.
HueBlockResult CompareHueBlock(const HueBlock& block, float cosine2, std::uint8_t* out);

}  // namespace etude
