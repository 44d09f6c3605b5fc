#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"
#include "sim/body/cuboid.h"

namespace etude {

/// Which joints of one frame are hidden.
using HiddenJoints = std::array<bool, kRoleCount>;

/// What may stand between a sensor and the body, beside the body itself.
struct Occluders {
  std::vector<Cuboid> furniture;
  std::vector<BodyPose> bystander;  ///< a second person: a pose per frame (the last one stays), none = nobody
};

/// Which joints of `pose` in this frame `eye` does not see: the ray to the joint meets another part of the body,
/// furniture or the second person clearly (2 cm) before the joint's own skin. The flesh is what the renderer draws
/// (sim/body).
HiddenJoints FindHidden(const BodyPose& pose, std::size_t frame, const Occluders& occluders, const glm::dvec3& eye);

}  // namespace etude
