#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// The place where a joint of the body shall be, and its accuracy.
struct JointTarget {
  glm::dvec3 p_WQ{0};
  double sigma_m = 0.01;  ///< standard deviation along each axis, metres
};

/// The targets by role; nothing for joints whose place is not known.
using JointTargets = std::array<std::optional<JointTarget>, kRoleCount>;

/// Finds the pose of the body that comes nearest to the targets, by Levenberg and Marquardt's method; angles that these
/// leave open are as habit has them. From `start`, or, without one, from the postures and headings that a person is
/// looked for with.
TreeState FitJoints(const SilhouetteBody& body, const JointTargets& targets,
                    const std::optional<TreeState>& start = std::nullopt);

/// Makes targets of all twenty joints of `pose`, equally exact.
JointTargets TargetsOf(const BodyPose& pose, double sigma_m = 0.01);

/// Turns the body the other way round *(ours)*: its left limbs where the right ones are in `state` and these where the
/// left ones are, as nearly as its joints allow; feet and head point where they then may. Its outlines are much the
/// same.
TreeState TurnedRound(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
