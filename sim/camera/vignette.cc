#include "sim/camera/vignette.h"

#include <cmath>

namespace etude {

void AddVignette(const Camera& camera, double strength, Transmission& transmission) {
  const Intrinsics& in = camera.intrinsics;
  for (int y = 0; y < transmission.height; ++y) {
    for (int x = 0; x < transmission.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const glm::dvec2 straight = UndistortPixel(camera, pixel).value_or(pixel);
      const double across = (straight.x - in.cx) / in.fx, down = (straight.y - in.cy) / in.fy;
      transmission.At(x, y) *= static_cast<float>(std::pow(1 + across * across + down * down, -2 * strength));
    }
  }
}

}  // namespace etude
