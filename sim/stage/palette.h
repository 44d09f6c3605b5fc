#pragma once

#include "engine/base/image.h"
#include "sim/random/stream.h"

namespace etude {

/// A colour by hue (degrees), saturation and value, 0…1.
struct Hsv {
  double hue = 0;
  double saturation = 0;
  double value = 0;
};

Rgb8 ToRgb(const Hsv& colour);
Hsv ToHsv(Rgb8 colour);

/// Mixes two colours from `a` (share 0) to `b` (share 1), hues the shorter way round.
Hsv Mixed(const Hsv& a, const Hsv& b, double share);

/// Draws a colour of things that people live with, walls and clothes alike: often wood and leather, some denim, some
/// green, sometimes anything. It always takes as many numbers.
Hsv DrawColour(RandomStream& random);

/// Draws a colour of the studio's things: hues of 150–230°, away from its performers.
Hsv DrawStudioColour(RandomStream& random);

}  // namespace etude
