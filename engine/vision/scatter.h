#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace etude {

/// Sums over pixels: squares and products of the coordinates' deviations from the mean pixel.
struct Scatter {
  double xx = 0, xy = 0, yy = 0;

  void Add(const glm::dvec2& offset) {
    xx += offset.x * offset.x;
    xy += offset.x * offset.y;
    yy += offset.y * offset.y;
  }
  /// Returns the unit vector of the principal axis, the direction in which the pixels' positions vary most.
  glm::dvec2 Axis() const {
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    return {std::cos(angle), std::sin(angle)};
  }
  /// Returns the sum of squared deviations along the principal axis.
  double AlongAxis() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
};

}  // namespace etude
