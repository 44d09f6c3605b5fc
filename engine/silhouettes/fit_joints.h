#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// Where a joint of the body shall be, and how exactly that is known.
struct JointTarget {
  glm::dvec3 p_WQ{0};
  double sigma_m = 0.01;  ///< standard deviation along each axis, metres
};

/// One per role; nothing for joints that nobody knows.
using JointTargets = std::array<std::optional<JointTarget>, kRoleCount>;

/// The pose of the body that comes nearest to the targets, by Levenberg and Marquardt's method; angles that these leave
/// open are as habit has them. From `start`, or, without one, from the postures and headings that a person is looked
/// for with.
TreeState FitJoints(const SilhouetteBody& body, const JointTargets& targets,
                    const std::optional<TreeState>& start = std::nullopt);

/// All twenty joints of `pose`, equally exact.
JointTargets TargetsOf(const BodyPose& pose, double sigma_m = 0.01);

}  // namespace etude
