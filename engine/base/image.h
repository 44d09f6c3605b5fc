#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] etude {

/// A picture of `width` × `height` pixels, row by row from the top left. Pixel (x, y) covers the square [x, x+1) × [y,
/// y+1); its centre is (x + 0.5, y + 0.5).
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
/// A binary picture: 1 for pixels of the object, 0 for the background.
using Mask = Image<std::uint8_t>;
/// Depths along the camera's viewing axis, metres; infinity where no surface is hit.
using DepthImage = Image<float>;
/// The object that each pixel shows, as a number defined by the renderer (`sim/render`).
using LabelImage = Image<std::uint32_t>;

/// A picture that is mapped to a surface by coordinates (u, v): (0, 0) is its upper left corner, (1, 1) the lower right
/// one.
struct Texture {
  /// The continuation of a texture at coordinates outside 0…1: the picture again, its mirror image, or the nearest
  /// pixel of its edge.
  enum class Beyond { kRepeats, kMirrors, kStays };

  ColourImage picture;
  Beyond beyond_u = Beyond::kRepeats, beyond_v = Beyond::kRepeats;
};

/// An immutable texture, shared by a file's materials, the surfaces of every frame and the renderer because it is
/// large.
using SharedTexture = std::shared_ptr<const Texture>;

/// Converts an sRGB value to linear light, 0…1 (IEC 61966-2-1).
double LinearOfSrgb(std::uint8_t value);

/// Converts linear light, clamped to 0…1, to the nearest sRGB value.
std::uint8_t SrgbOfLinear(double light);

}  // namespace etude
