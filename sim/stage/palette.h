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

/// Interpolates from colour `a` (share 0) to `b` (share 1); hues take the shorter way round.
Hsv Mixed(const Hsv& a, const Hsv& b, double share);

/// Draws a colour of everyday objects, walls and clothes: often wood and leather, some denim, some green, and sometimes
/// any hue. The number of draws is constant.
Hsv DrawColour(RandomStream& random);

/// Draws a colour of the studio's objects: hues of 150–230°, which its performers do not have.
Hsv DrawStudioColour(RandomStream& random);

}  // namespace etude
