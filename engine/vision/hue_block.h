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
  std::size_t compared = 0;  ///< how many were, from the first on: whole vectors
  bool is_sure = true;       ///< false when rounding may have decided about one
};

/// Writes 1 to `out` where the hues are further apart than an angle with the squared cosine `cosine2`, else 0, by
/// vectors in single precision. Scalar products of chromas are whole numbers below 2²⁴, so only their squares are
/// rounded.
HueBlockResult CompareHueBlock(const HueBlock& block, float cosine2, std::uint8_t* out);

}  // namespace etude
