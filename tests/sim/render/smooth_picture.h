#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/renderer.h"

namespace etude {

/// Draws a picture with smooth edges: at twice the size, then averages 2 × 2 pixels.
inline ColourImage DrawSmooth(Renderer& renderer, const std::vector<Figure>& figures, Camera camera) {
  ColourImage picture(camera.intrinsics.width, camera.intrinsics.height);
  Intrinsics& in = camera.intrinsics;
  in.width *= 2;
  in.height *= 2;
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length *= 2;
  const ColourImage large = renderer.Render({}, figures, camera, Targets::kColour).colour;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto mean = [&](std::uint8_t Rgb8::*part) {
        int sum = 2;
        for (const int i : {0, 1, 2, 3}) sum += large.At(2 * x + i % 2, 2 * y + i / 2).*part;
        return static_cast<std::uint8_t>(sum / 4);
      };
      picture.At(x, y) = {mean(&Rgb8::r), mean(&Rgb8::g), mean(&Rgb8::b)};
    }
  }
  return picture;
}

}  // namespace etude
