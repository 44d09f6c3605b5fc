#pragma once

#include "engine/kinematics/body_tree.h"
#include "sim/random/stream.h"

namespace etude {

/// The truth of a trial after paper B's figure 3.8, on the body of `MakeBodyTree`, for a start that stands at rest with
/// hanging arms. *Ours*: the body crouches by 2h, upright, and bends its arms, so that its head is 2h lower, both hands
/// are h higher, each along its stretched arm, and all effectors' axes and the right foot are as in the start. From
/// there, JᵀΔX = 0: the three pulls go through their limbs' joints, and their sum and its moment vanish. A method that
/// goes by the gradient stays where it is. h is drawn: some 4 to 23 mm.
TreeState CrouchBeneathStandingHands(const KinematicTree& tree, RandomStream& dice);

}  // namespace etude
