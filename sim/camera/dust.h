#pragma once

#include <vector>

#include "sim/camera/vignette.h"
#include "sim/random/stream.h"

namespace etude {

/// A speck of dust before the sensor: its shadow is soft, because the light comes from the whole lens.
struct Speck {
  double x = 0, y = 0;  ///< pixels
  double radius = 0;    ///< pixels, to where half of the shadow is left
};

/// Ten specks of 2 to 6 pixels, anywhere in a picture of that size.
std::vector<Speck> ThrowSpecks(int width, int height, RandomStream& random);

/// Each speck keeps `strength` of the light away in its middle, and half as much at its radius:
/// strength / (1 + (d / radius)⁴) at distance d. Shadows of several multiply.
void AddDust(const std::vector<Speck>& specks, double strength, Transmission& transmission);

}  // namespace etude
