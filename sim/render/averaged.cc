#include <algorithm>

#include "sim/render/averaged.h"
#include "sim/render/renderer.h"

namespace etude {

Camera Doubled(const Camera& camera) {
  Camera doubled = camera;
  Intrinsics& in = doubled.intrinsics;
  in.width *= 2;
  in.height *= 2;
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length *= 2;
  return doubled;
}

void AverageFours(const ColourImage& large, const PixelRect& rect, ColourImage& small) {
  const auto mean = [](int p, int q, int r, int s) { return static_cast<std::uint8_t>((p + q + r + s + 2) / 4); };
  for (int y = rect.top / 2; y < (rect.bottom + 1) / 2; ++y) {
    const Rgb8* upper = &large.At(0, 2 * y);
    const Rgb8* lower = &large.At(0, 2 * y + 1);
    Rgb8* out = &small.At(0, y);
    for (int x = rect.left / 2; x < (rect.right + 1) / 2; ++x) {
      const Rgb8 &a = upper[2 * x], &b = upper[2 * x + 1], &c = lower[2 * x], &d = lower[2 * x + 1];
      out[x] = {mean(a.r, b.r, c.r, d.r), mean(a.g, b.g, c.g, d.g), mean(a.b, b.b, c.b, d.b)};
    }
  }
}

}  // namespace etude
