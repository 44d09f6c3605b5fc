#pragma once

#include <algorithm>

namespace etude {

/// Returns 0 up to `low`, 1 from `high` on, and between them 3t² − 2t³: the speed is zero at both ends.
constexpr double Smoothstep(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Returns 0 up to t = 0 and 1 from t = 1 on: speed and acceleration are zero at both ends (Perlin 2002).
constexpr double Smootherstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

}  // namespace etude
