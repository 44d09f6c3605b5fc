#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace etude {

/// Returns the angle between two vectors of any length, in [0, π]; 0 if one of the vectors is zero. atan2(|u×v|, u·v)
/// keeps full precision near 0 and π, where acos loses half the digits.
inline double AngleBetween(const glm::dvec3& u, const glm::dvec3& v) {
  // Adding 0.0 turns −0 into 0. (−0 is a product of zero and a negative number; atan2 would return π for it.)
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v) + 0.0);
}

/// Returns `v` normalised, or `otherwise` if `v` is shorter than 1e-9.
inline glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  constexpr double kMinLength = 1e-9;
  const double length = glm::length(v);
  return length < kMinLength ? otherwise : v / length;
}

}  // namespace etude
