#pragma once

#include <optional>
#include <span>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

// The functions below model the body as a linear inverted pendulum (Kajita et al. 2001): a mass that keeps its height
// above the joints that bear it.

/// Returns the acceleration of the centre of mass in frame `frame`, metres per second²: the second difference over a
/// tenth of a second in each direction. In the first and the last tenth of a second, the nearest frame outside of these
/// is used. Returns 0 if the motion is too short.
glm::dvec3 AccelerationAt(std::span<const glm::dvec3> centres, int frame, double rate_hz);

/// Returns the zero-moment point (x, z), metres: the point of the floor about which the floor's force on the body has
/// no horizontal moment. `centres` holds the centre of mass in every frame; `ground` is the height of the floor.
glm::dvec2 ZeroMomentPoint(std::span<const glm::dvec3> centres, int frame, double rate_hz, double ground);

/// Returns the horizontal distance from the zero-moment point to the joints that bear the body, metres; nullopt without
/// such joints. `centres` holds the centre of mass in every frame; `pose` is the pose in frame `frame`.
std::optional<double> ZeroMomentOffset(std::span<const glm::dvec3> centres, int frame, double rate_hz,
                                       const BodyPose& pose, const JointSet& bears);

}  // namespace etude
