#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// The target position of a joint of the body, and its accuracy.
struct JointTarget {
  glm::dvec3 p_WQ{0};
  double sigma_m = 0.01;  ///< standard deviation along each axis, metres
};

/// The targets by role; nullopt for joints whose position is not known.
using JointTargets = std::array<std::optional<JointTarget>, kRoleCount>;

/// Finds the body's pose nearest to the targets by the method of Levenberg and Marquardt. The angle priors
/// (`SilhouetteBody::Habit`) determine the angles that the targets leave open. The search starts from `start` or,
/// without it, from several headings and the `Postures`.
TreeState FitJoints(const SilhouetteBody& body, const JointTargets& targets,
                    const std::optional<TreeState>& start = std::nullopt);

/// Makes targets of all twenty joints of `pose` with equal accuracy.
JointTargets TargetsOf(const BodyPose& pose, double sigma_m = 0.01);

/// Turns the body front to back *(ours)*: each limb moves to the position that the same limb of the other side has in
/// `state`, as far as the joints' limits allow. Feet and head are not constrained. The silhouettes of both poses are
/// nearly the same.
TreeState TurnedRound(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
