#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace etude {

/// The angle between two vectors of any length, in [0, π]; 0 when either is zero. Uses
/// atan2(|u×v|, u·v), which keeps full precision near 0 and π, where acos loses half the digits.
inline double AngleBetween(const glm::dvec3& u, const glm::dvec3& v) {
  // + 0.0: a product of zeros and negative numbers is −0, at which the angle would be π.
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v) + 0.0);
}

/// Returns `v` at length 1; `otherwise` where it has no direction to speak of (shorter than 1e-9).
inline glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  constexpr double kNoLength = 1e-9;
  const double length = glm::length(v);
  return length < kNoLength ? otherwise : v / length;
}

}  // namespace etude
