#pragma once

#include <glm/glm.hpp>

namespace etude {

/// A solid box that stands upright, turned about the vertical: furniture, as far as rays and pictures need it. Metres.
struct Cuboid {
  glm::dvec3 centre{0};
  glm::dvec3 half_size{0.5};  ///< along its own axes, each positive
  double heading = 0;         ///< radians: its own +Z points to (sin heading, 0, cos heading)
};

/// The distance along the ray (unit direction) to the box's surface, or infinity. A ray that starts inside meets it at
/// 0.
double HitDistance(const Cuboid& box, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace etude
