#include "sim/stage/palette.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

std::uint8_t ToByte(double share) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))); }

double Wrapped(double degrees) { return degrees - 360 * std::floor(degrees / 360); }

}  // namespace

Rgb8 ToRgb(const Hsv& colour) {
  const auto channel = [&](double shift) {
    const double sector = std::fmod(shift + Wrapped(colour.hue) / 60, 6.0);
    const double fall = std::clamp(std::min(sector, 4 - sector), 0.0, 1.0);
    return ToByte(colour.value * (1 - colour.saturation * fall));
  };
  return {channel(5), channel(3), channel(1)};
}

Hsv ToHsv(Rgb8 colour) {
  const double r = colour.r / 255.0, g = colour.g / 255.0, b = colour.b / 255.0;
  const double value = std::max({r, g, b}), range = value - std::min({r, g, b});
  if (range == 0) return {0, 0, value};
  double sextant = value == r ? (g - b) / range : value == g ? 2 + (b - r) / range : 4 + (r - g) / range;
  return {Wrapped(60 * sextant), range / value, value};
}

Hsv Mixed(const Hsv& a, const Hsv& b, double share) {
  const double turn = std::remainder(b.hue - a.hue, 360.0);
  return {Wrapped(a.hue + share * turn), std::lerp(a.saturation, b.saturation, share),
          std::lerp(a.value, b.value, share)};
}

Hsv DrawColour(RandomStream& random) {
  const double kind = random.Uniform(), spread = random.Normal(), any = random.Uniform();
  const double saturation = random.Uniform(0.28, 0.62), value = random.Uniform(0.38, 0.85);
  double hue = 360 * any;
  if (kind < 0.50) {
    hue = 27 + 10 * spread;
  } else if (kind < 0.76) {
    hue = 214 + 14 * spread;
  } else if (kind < 0.86) {
    hue = 105 + 25 * spread;
  }
  return {Wrapped(hue), saturation, value};
}

Hsv DrawStudioColour(RandomStream& random) {
  const double hue = random.Uniform(150, 230), saturation = random.Uniform(0.35, 0.55);
  return {hue, saturation, random.Uniform(0.45, 0.75)};
}

}  // namespace etude
