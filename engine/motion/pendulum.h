#pragma once

#include <optional>
#include <span>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// The body as a linear inverted pendulum (Kajita et al. 2001): a mass that stays at its height above the joints that
/// bear it.

/// Returns the acceleration of a mass centre in frame `frame`, metres per second²: its second difference over a tenth
/// of a second in each direction, or that of the nearest frame that has both neighbours. 0 in a shorter motion.
glm::dvec3 AccelerationAt(std::span<const glm::dvec3> centres, int frame, double rate_hz);

/// Returns the zero-moment point (x, z): where the ground bears the body of which `centres` holds the mass centre in
/// every frame. `ground` is the height of the floor there.
glm::dvec2 ZeroMomentPoint(std::span<const glm::dvec3> centres, int frame, double rate_hz, double ground);

/// Returns the distance, seen from above, from the zero-moment point to the joints that bear the body, metres; nothing
/// without such joints. `centres` holds the mass centre in every frame, `pose` is that of frame `frame`.
std::optional<double> ZeroMomentOffset(std::span<const glm::dvec3> centres, int frame, double rate_hz,
                                       const BodyPose& pose, const JointSet& bears);

}  // namespace etude
