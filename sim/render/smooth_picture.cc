#include "sim/render/renderer.h"

namespace etude {

ColourImage Renderer::RenderSmooth(const Room& room, const std::vector<Figure>& figures, const Camera& camera) {
  Camera doubled = camera;
  Intrinsics& in = doubled.intrinsics;
  in.width *= 2;
  in.height *= 2;
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length *= 2;
  const ColourImage large = Render(room, figures, doubled, Targets::kColour).colour;

  ColourImage smooth(camera.intrinsics.width, camera.intrinsics.height);
  for (int y = 0; y < smooth.height; ++y) {
    for (int x = 0; x < smooth.width; ++x) {
      const Rgb8 &a = large.At(2 * x, 2 * y), &b = large.At(2 * x + 1, 2 * y);
      const Rgb8 &c = large.At(2 * x, 2 * y + 1), &d = large.At(2 * x + 1, 2 * y + 1);
      const auto mean = [](int p, int q, int r, int s) { return static_cast<std::uint8_t>((p + q + r + s + 2) / 4); };
      smooth.At(x, y) = {mean(a.r, b.r, c.r, d.r), mean(a.g, b.g, c.g, d.g), mean(a.b, b.b, c.b, d.b)};
    }
  }
  return smooth;
}

}  // namespace etude
