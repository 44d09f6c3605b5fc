#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The body's centre of mass, metres: segment masses and centres after Winter, "Biomechanics and motor control of human
/// movement" (table 4.1, from Dempster); the trunk's mass lies evenly along its two straight parts.
glm::dvec3 CentreOfMass(const BodyPose& pose);

/// The part of a foot that touches the floor, seen from above (x, z): the whole sole, the ball of the foot when its
/// heel is up, nothing when it is in the air.
std::vector<glm::dvec2> Sole(const BodyPose& pose, Side side);

/// Returns how far `point` lies outside the convex hull of `corners` (at least three, not in a line); 0 inside.
double DistanceOutside(const glm::dvec2& point, std::vector<glm::dvec2> corners);

}  // namespace etude
