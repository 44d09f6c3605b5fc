#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
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
/// A picture of 1 where a pixel belongs to the thing looked for, and 0 elsewhere.
using Mask = Image<std::uint8_t>;
/// A picture of distances along the camera's viewing axis in metres; infinity where nothing was hit.
using DepthImage = Image<float>;
/// The thing that each pixel shows, as a number whose meaning is the renderer's (`sim/render`).
using LabelImage = Image<std::uint32_t>;

/// A picture that is laid on a surface by coordinates (u, v): (0, 0) is its upper left corner, (1, 1) the lower right
/// one.
struct Texture {
  /// Says how the picture goes on beyond 0…1.
  enum class Beyond { kRepeats, kMirrors, kStays };

  ColourImage picture;
  Beyond beyond_u = Beyond::kRepeats, beyond_v = Beyond::kRepeats;
};

/// A texture shared between a file's materials, the surfaces of every frame and what draws them: large, and never
/// changed.
using SharedTexture = std::shared_ptr<const Texture>;

/// Returns the linear light, 0…1, of a screen's value (IEC 61966-2-1).
double LinearOfSrgb(std::uint8_t value);

/// Returns the screen's value nearest to linear light, which is clamped to 0…1.
std::uint8_t SrgbOfLinear(double light);

}  // namespace etude
