#include "sim/render/backdrop.h"

#include <algorithm>

namespace etude {
namespace {

template <typename Pixel>
void Shape(int width, int height, bool wanted, Image<Pixel>& image) {
  if (!wanted) {
    image = {};
  } else if (image.width != width || image.height != height) {
    image = Image<Pixel>(width, height);
  }
}

}  // namespace

void RoundToBytes(const float* light, std::size_t count, float brightness, std::uint8_t* bytes) {
  // Added to 2²³, a float has no room for fractions: its last bits are the rounded number.
  constexpr float kWhole = 8388608;
  for (std::size_t i = 0; i < count; ++i) {
    const float level = std::min(std::max(light[i] * brightness, 0.0f), 1.0f) * 255.0f;
    const float whole = (level + kWhole) - kWhole;
    bytes[i] = static_cast<std::uint8_t>(static_cast<int>(whole));
  }
}

void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows,
                  View& view) {
  const int height = rows.end - rows.first;
  Shape(width, height, true, view.colour);
  Shape(width, height, targets != Targets::kColour, view.labels);
  Shape(width, height, targets == Targets::kAll, view.depth);
  const std::size_t first = static_cast<std::size_t>(width) * rows.first;
  const std::size_t count = static_cast<std::size_t>(width) * height;

  static_assert(sizeof(Rgb8) == 3, "a picture's bytes are its colours");
  RoundToBytes(&room.colours[3 * first], 3 * count, static_cast<float>(brightness),
               reinterpret_cast<std::uint8_t*>(view.colour.pixels.data()));
  if (targets != Targets::kColour) std::copy_n(&room.labels[first], count, view.labels.pixels.begin());
  if (targets == Targets::kAll) std::copy_n(&room.depths[first], count, view.depth.pixels.begin());
}

void FillBackdrop(const KeptRoom& room, double brightness, const PixelRect& rect, ColourImage& picture) {
  for (int y = rect.top; y < rect.bottom; ++y) {
    const std::size_t first = static_cast<std::size_t>(picture.width) * y + rect.left;
    RoundToBytes(&room.colours[3 * first], 3 * static_cast<std::size_t>(rect.Width()), static_cast<float>(brightness),
                 reinterpret_cast<std::uint8_t*>(&picture.At(rect.left, y)));
  }
}

}  // namespace etude
