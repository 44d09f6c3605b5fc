#pragma once

#include <algorithm>

namespace etude {

/// Returns 0 below `low`, 1 above `high`, and 3t² − 2t³ in between; the first derivative is zero at both ends.
constexpr double Smoothstep(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Returns 0 for t ≤ 0, 1 for t ≥ 1 and 6t⁵ − 15t⁴ + 10t³ in between; first and second derivative are zero at both ends
/// (Perlin 2002).
constexpr double Smootherstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

}  // namespace etude
