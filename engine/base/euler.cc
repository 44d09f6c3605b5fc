#include "engine/base/euler.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {

glm::dmat3 AxisRotation(const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  const double x = axis.x, y = axis.y, z = axis.z;
  // GLM's constructor takes the columns one after the other.
  return {t * x * x + c,     t * x * y + s * z, t * x * z - s * y,  //
          t * x * y - s * z, t * y * y + c,     t * y * z + s * x,  //
          t * x * z + s * y, t * y * z - s * x, t * z * z + c};
}

glm::dmat3 RotationXyz(const glm::dvec3& angles) {
  const double cx = std::cos(angles.x), sx = std::sin(angles.x);
  const double cy = std::cos(angles.y), sy = std::sin(angles.y);
  const double cz = std::cos(angles.z), sz = std::sin(angles.z);
  return {cy * cz,
          cx * sz + sx * sy * cz,
          sx * sz - cx * sy * cz,  //
          -cy * sz,
          cx * cz - sx * sy * sz,
          sx * cz + cx * sy * sz,  //
          sy,
          -sx * cy,
          cx * cy};
}

glm::dvec3 AnglesXyz(const glm::dmat3& rotation) {
  // Below this |cos y|, the first row is rounding noise, so z cannot be read from it.
  constexpr double kMinCosY = 1e-6;
  const double cos_y = std::hypot(rotation[0].x, rotation[1].x);
  const double x = std::atan2(-rotation[2].y, rotation[2].z), y = std::atan2(rotation[2].x, cos_y);
  if (cos_y > kMinCosY) return {x, y, std::atan2(-rotation[1].x, rotation[0].x)};
  // Near gimbal lock, undo the rotation about x first, and read z from the result; this is exact for any x.
  const double c = std::cos(x), s = std::sin(x);
  return {x, y, std::atan2(c * rotation[0].y + s * rotation[0].z, c * rotation[1].y + s * rotation[1].z)};
}

glm::dmat3 SmallestRotation(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(from, to);
  const double sine = glm::length(normal);
  if (sine > 1e-12) return AxisRotation(normal / sine, std::atan2(sine, glm::dot(from, to)));
  if (glm::dot(from, to) > 0) return glm::dmat3(1);
  // The coordinate axis that deviates most from `from` is never parallel to it.
  const glm::dvec3 size = glm::abs(from);
  const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
  return AxisRotation(UnitNormalPart(other, from), kPi);
}

glm::dvec3 UnitNormalPart(const glm::dvec3& v, const glm::dvec3& axis) {
  return glm::normalize(v - glm::dot(v, axis) * axis);
}

}  // namespace etude
