#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace etude {

constexpr double kPi = std::numbers::pi;

constexpr double Radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double Degrees(double radians) { return radians * (180.0 / kPi); }

/// The angle between two vectors of any length, in [0, π]; 0 when either is zero. Uses
/// atan2(|u×v|, u·v), which keeps full precision near 0 and π, where acos loses half the digits.
inline double AngleBetween(const glm::dvec3& u, const glm::dvec3& v) {
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

}  // namespace etude
