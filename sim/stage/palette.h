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

/// Interpolates between colour `a` (share 0) and `b` (share 1). Hues are interpolated the shorter way around the
/// circle.
Hsv Mixed(const Hsv& a, const Hsv& b, double share);

/// Draws a colour of everyday objects, walls and clothes: often wood or leather, less often denim or green, and
/// sometimes any hue. The number of random numbers is constant.
Hsv DrawColour(RandomStream& random);

/// Draws a colour of the studio's objects, with a hue of 150–230°. The performer's clothes in the studio have no such
/// hue.
Hsv DrawStudioColour(RandomStream& random);

}  // namespace etude
