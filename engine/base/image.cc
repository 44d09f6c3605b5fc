#include "engine/base/image.h"

#include <algorithm>
#include <cmath>

namespace etude {

double LinearOfSrgb(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint8_t SrgbOfLinear(double light) {
  const double clamped = std::clamp(light, 0.0, 1.0);
  const double v = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * v));
}

}  // namespace etude
