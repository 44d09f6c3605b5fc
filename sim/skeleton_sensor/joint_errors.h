#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// How far each joint of each frame is reported from where it is, metres, in the world.
using JointErrors = std::vector<std::array<glm::dvec3, kRoleCount>>;

/// The continuous errors of plainly seen joints. In units of its group's size, and along the line of sight and two
/// axes across it, a joint's error is ρ times its parent's and √(1 − ρ²) of its own; its own depends on the pose, with
/// a share that is fast and comes in bursts. To that comes the wander of a body at rest, joint by joint.
JointErrors ContinuousErrors(const BodyMotion& truth, const Camera& sensor, const SkeletonSensorOptions& options,
                             const WorldKey& world);

}  // namespace etude
