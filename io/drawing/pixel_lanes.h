#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "sim/render/scene.h"

namespace etude {

// Operations on all pixels of a picture, written as loops that compilers turn into vector instructions. Pixels are
// 0x00RRGGBB.

/// Shrinks pictures; each pixel of the small picture is the mean of the large picture's pixels that it covers.
class Shrinker {
 public:
  /// Makes a shrinker for pictures of the large size. The large size may be at most three times the small size.
  Shrinker(int large_width, int large_height, int small_width, int small_height);

  /// Computes only the small pixels that the rectangle `rect` of the large picture touches.
  void Shrink(const Image<std::uint32_t>& large, const PixelRect& rect, Image<std::uint32_t>& small) const;

 private:
  static constexpr int kTaps = 4;
  /// The pixels of a row or column that one small pixel covers, with weights in 256ths.
  struct Cover {
    int first = 0;
    std::uint16_t weights[kTaps] = {};
  };
  static std::vector<Cover> CoversOf(int large, int small);

  std::vector<Cover> columns_, rows_;
};

/// Converts pixels to I420 (Canvas::ToI420). Rows are `stride` bytes apart; width and height are even.
void PixelsToI420(const unsigned char* pixels, int stride, int width, int height, std::uint8_t* planes);

}  // namespace etude
