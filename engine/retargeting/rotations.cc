#include "engine/retargeting/rotations.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// Sines below this are rounding, not directions.
constexpr double kDegenerate = 1e-9;

}  // namespace

glm::dquat ShortestTurn(const glm::dvec3& from, const glm::dvec3& to) {
  const double lengths = glm::length(from) * glm::length(to);
  if (!(lengths > 0)) return {1, 0, 0, 0};
  const glm::dvec3 across = glm::cross(from, to) / lengths;
  const double cosine = glm::dot(from, to) / lengths;
  const double sine = glm::length(across);
  if (sine > kDegenerate || cosine > 0) {
    const double half = 0.5 * std::atan2(sine, cosine);
    const glm::dvec3 axis = sine > 0 ? across / sine : glm::dvec3(0);
    return glm::normalize(glm::dquat(std::cos(half), std::sin(half) * axis));
  }
  const glm::dvec3 some = std::abs(from.x) < 0.5 * glm::length(from) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  return glm::angleAxis(kPi, glm::normalize(glm::cross(from, some)));
}

glm::dquat Orientation(const glm::dvec3& x, const glm::dvec3& y) {
  const glm::dvec3 z = glm::cross(x, y);
  const double sine = glm::length(z);
  if (!(sine > kDegenerate * glm::length(x) * glm::length(y)) || !(sine > 0)) {
    return ShortestTurn({1, 0, 0}, x);
  }
  const glm::dvec3 along = glm::normalize(x), out = z / sine;
  return glm::normalize(glm::quat_cast(glm::dmat3(along, glm::cross(out, along), out)));
}

}  // namespace etude
