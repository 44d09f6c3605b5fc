#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "sim/render/scene.h"

namespace etude {

// What is done to every pixel of a film: loops that become vector instructions. Pixels are 0x00RRGGBB.

/// Shrinks pictures that were drawn larger, by the mean of the pixels that each pixel covers.
class Shrinker {
 public:
  /// Makes a shrinker of pictures `large` pixels wide and high to `small` ones; at most three times smaller.
  Shrinker(int large_width, int large_height, int small_width, int small_height);

  /// Shrinks what a rectangle of the large picture touches.
  void Shrink(const Image<std::uint32_t>& large, const PixelRect& rect, Image<std::uint32_t>& small) const;

 private:
  static constexpr int kTaps = 4;
  /// The pixels of a row or column that one pixel covers, in 256ths.
  struct Cover {
    int first = 0;
    std::uint16_t weights[kTaps] = {};
  };
  static std::vector<Cover> CoversOf(int large, int small);

  std::vector<Cover> columns_, rows_;
};

/// Converts pixels to I420 (Canvas::ToI420). Rows are `stride` bytes apart, sides even.
void PixelsToI420(const unsigned char* pixels, int stride, int width, int height, std::uint8_t* planes);

}  // namespace etude
