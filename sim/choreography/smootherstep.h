#pragma once

#include <algorithm>

namespace etude {

/// From 0 at t = 0 to 1 at t = 1, with zero speed and acceleration at both ends and constant beyond (Perlin 2002).
constexpr double Smootherstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

}  // namespace etude
