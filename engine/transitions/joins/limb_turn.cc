#include "engine/transitions/joins/limb_turn.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"

namespace etude {

LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(from, to);
  const double length = glm::length(normal);
  const double angle = AngleBetween(from, to);
  if (length > 0) return normal * (angle / length);
  if (angle == 0) return LimbTurn(0);
  const glm::dvec3 helper = std::abs(from.y) < std::abs(from.x) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(from, helper)) * angle;
}

glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn) {
  const double angle = glm::length(turn);
  return angle > 0 ? glm::angleAxis(angle, turn / angle) * v : v;
}

}  // namespace etude
