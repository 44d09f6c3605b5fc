#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace etude {

/// A picture: `width` × `height` pixels in rows from the top, row-major, origin at the top left.
/// Pixel (x, y) covers the square [x, x+1) × [y, y+1); its centre is (x + 0.5, y + 0.5).
template <typename Pixel>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int w, int h, Pixel fill = {}) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}

  bool Contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  Pixel& At(int x, int y) {
    assert(Contains(x, y));
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
  const Pixel& At(int x, int y) const {
    assert(Contains(x, y));
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
};

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};

using ColourImage = Image<Rgb8>;
/// 1 = belongs to the thing looked for, 0 = does not.
using Mask = Image<std::uint8_t>;
/// Distance along the camera's viewing axis in metres; infinity where nothing was hit.
using DepthImage = Image<float>;
/// What each pixel shows; the meaning of the numbers is the renderer's (`sim/render`).
using LabelImage = Image<std::uint32_t>;

}  // namespace etude
