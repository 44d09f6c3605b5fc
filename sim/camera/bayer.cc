#include "sim/camera/bayer.h"

#include <vector>

namespace etude {
namespace {

/// A row with a mirrored pixel at either end: [−1] is [1].
void Pad(const float* row, int width, float* padded) {
  padded[0] = row[1];
  for (int x = 0; x < width; ++x) padded[x + 1] = row[x];
  padded[width + 1] = row[width - 2];
}

/// The row's own colour (red or blue), green, and the colour of the rows above and below.
struct Colours {
  float own, green, other;
};

/// At a pixel that holds the row's own colour.
Colours AtOwn(const float* above, const float* here, const float* below) {
  return {here[0], 0.25f * ((here[-1] + here[1]) + (above[0] + below[0])),
          0.25f * ((above[-1] + above[1]) + (below[-1] + below[1]))};
}

/// At a green pixel.
Colours AtGreen(const float* above, const float* here, const float* below) {
  return {0.5f * (here[-1] + here[1]), here[0], 0.5f * (above[0] + below[0])};
}

template <bool kRedRow>
Light InOrder(const Colours& c) {
  return kRedRow ? Light{c.own, c.green, c.other, 0} : Light{c.other, c.green, c.own, 0};
}

template <bool kRedRow>
void DemosaicRow(const float* above, const float* here, const float* below, int width, Light* out) {
  // Red rows begin with their own colour, blue ones with green.
  constexpr int kOwn = kRedRow ? 0 : 1;
  for (int x = kOwn; x < width; x += 2) out[x] = InOrder<kRedRow>(AtOwn(above + x, here + x, below + x));
  for (int x = 1 - kOwn; x < width; x += 2) out[x] = InOrder<kRedRow>(AtGreen(above + x, here + x, below + x));
}

}  // namespace

void Demosaic(const Mosaic& mosaic, LightImage& out) {
  const int width = mosaic.width, height = mosaic.height;
  const std::size_t stride = static_cast<std::size_t>(width) + 2;
  std::vector<float> rows(3 * stride);
  const auto padded = [&](int y) { return rows.data() + static_cast<std::size_t>((y + 3) % 3) * stride; };
  const auto mirrored = [&](int y) { return y < 0 ? 1 : y >= height ? height - 2 : y; };
  for (const int y : {-1, 0}) Pad(&mosaic.At(0, mirrored(y)), width, padded(y));
  for (int y = 0; y < height; ++y) {
    Pad(&mosaic.At(0, mirrored(y + 1)), width, padded(y + 1));
    const float *above = padded(y - 1) + 1, *here = padded(y) + 1, *below = padded(y + 1) + 1;
    if (y % 2 == 0) {
      DemosaicRow<true>(above, here, below, width, &out.At(0, y));
    } else {
      DemosaicRow<false>(above, here, below, width, &out.At(0, y));
    }
  }
}

}  // namespace etude
