#pragma once

#include <string>

#include "bench/tasks/ik/options.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// The truth of a trial after paper B's figure 3.8, on the body of `MakeBodyTree`, for a start that stands at rest with
/// hanging arms. *Ours*: the body crouches by 2h, upright, and bends its arms, so that its head is 2h lower, both hands
/// are h higher, each along its stretched arm, and all effectors' axes and the right foot are as in the start. From
/// there, JᵀΔX = 0: the three pulls go through their limbs' joints, and their sum and its moment vanish. A method that
/// goes by the gradient stays where it is. h is drawn: some 4 to 23 mm.
TreeState CrouchBeneathStandingHands(const KinematicTree& tree, RandomStream& dice);

/// One trial (after paper B's chapter 5): a true pose, and the problem of finding from another one to the places and
/// axes of its end effectors. The truth solves it, unless the options disturb targets or pull one out of reach.
struct IkWorld {
  TreeState truth;
  IkProblem problem;
};

/// Poses are within the limits of `tree`, which are the problem's. Dice come from `key` alone; `options` only scales
/// what they say.
IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key);

std::string DigestOf(const IkWorld& world);

}  // namespace etude
