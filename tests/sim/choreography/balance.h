#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// Returns the body's centre of mass, metres. Segment masses and centres are from Winter, "Biomechanics and motor
/// control of human movement" (table 4.1, from Dempster); the trunk's mass is spread evenly along its two straight
/// parts.
glm::dvec3 CentreOfMass(const BodyPose& pose);

/// Returns the part of a foot that touches the floor, seen from above (x, z): the whole sole; the ball of the foot if
/// its heel is up; nothing if the foot is in the air.
std::vector<glm::dvec2> Sole(const BodyPose& pose, Side side);

/// Returns how far `point` lies outside the convex hull of `corners` (at least three, not in a line); 0 inside.
double DistanceOutside(const glm::dvec2& point, std::vector<glm::dvec2> corners);

}  // namespace etude
