#pragma once

#include <cmath>

namespace etude {

/// Whether two depths of neighbouring pixels (metres) belong to different surfaces: they differ by more than 3 % of the
/// nearer one, or one of them is missing (infinite).
inline bool IsDepthEdge(double a, double b) {
  if (std::isinf(a) || std::isinf(b)) return std::isinf(a) != std::isinf(b);
  return std::abs(a - b) > 0.03 * (a < b ? a : b);
}

}  // namespace etude
