#pragma once

#include <string>

#include "bench/tasks/ik/options.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the true pose of a trial in which a gradient method cannot leave its start, as in paper B's figure 3.8.
/// The start is the standing pose with hanging arms (StandingState); the true pose is Etude's own. The body crouches
/// by 2h and bends its arms. Compared with the start, the head is 2h lower, and each hand is h higher, on the line of
/// the stretched arm. The right foot and the axes of all effectors are unchanged. At the start JᵀΔX = 0: each of the
/// three position errors points along its limb through the joints, and the sum and the moment of these errors are
/// zero. h is random, about 4 to 23 mm.
TreeState StretchedLimbPose(const KinematicTree& tree, RandomStream& dice);

/// One trial (like those in paper B's chapter 5): a true pose, and the problem of reaching the positions and axes of
/// its end effectors from another pose. The true pose solves the problem, unless the options disturb targets or move
/// one out of reach.
struct IkWorld {
  TreeState truth;
  IkProblem problem;
};

/// Makes the world of `key`. Poses are within the limits of `tree`, which are also the limits of the problem. Random
/// numbers depend on `key` alone; `options` only scales them.
IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key);

std::string DigestOf(const IkWorld& world);

}  // namespace etude
