#pragma once

#include <span>
#include <string>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns the twenty joints of a pose of paper B's body (`MakeBodyTree`): the hip centre is the navel, the spine lies
/// at `kSpineShare` of the way from navel to neck.
BodyPose ToBodyPose(const KinematicTree& body, const TreeState& state);

/// Returns a motion of paper B's body as a clip of its own skeleton, metres, Y up, rooted at the hips as other programs
/// expect: the pelvis's frame becomes the root's rotation, and the left leg, which the tree climbs, is turned round.
/// Exact: ComputeGlobals gives every joint the position that `ToBodyPose` gives. Joint names are MotionBuilder's, so
/// that FindJointMap knows them; "LowerBack" lies on the hips and carries the navel's turn. At rest the skeleton stands
/// with hanging arms, facing +Z.
Clip ToClip(const KinematicTree& body, std::span<const TreeState> states, double rate_hz, const std::string& name);

}  // namespace etude
