#include "engine/vision/hsi.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {

Hsi ToHsi(Rgb8 colour) {
  const double r = colour.r, g = colour.g, b = colour.b;
  const double sum = r + g + b;
  Hsi hsi;
  hsi.intensity = sum / 3;
  if (sum > 0) hsi.saturation = 1 - 3 * std::min({r, g, b}) / sum;

  const double spread = std::sqrt((r - g) * (r - g) + (r - b) * (g - b));
  if (spread == 0) return hsi;  // grey
  const double theta = std::acos(std::clamp(((r - g) + (r - b)) / 2 / spread, -1.0, 1.0));
  hsi.hue = b <= g ? theta : 2 * kPi - theta;
  return hsi;
}

}  // namespace etude
