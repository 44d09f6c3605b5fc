#pragma once

#include <span>
#include <string>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// The limbs of one person, metres, both sides alike. The default is an adult.
struct LimbLengths {
  double foot = 0.18;   ///< ankle to toe tips
  double shank = 0.42;  ///< knee to ankle
  double thigh = 0.43;  ///< hip to knee
  double hip_width = 0.18;
  double trunk = 0.50;           ///< navel (midway between the hips) to the base of the neck
  double neck = 0.25;            ///< base of the neck to the head
  double shoulder_width = 0.36;  ///< the base of the neck is its middle
  double upper_arm = 0.29;
  double forearm = 0.25;
  double hand = 0.18;  ///< wrist to finger tips
};

/// Returns whether every length is finite and more than zero.
bool IsValid(const LimbLengths& lengths);

/// Indices of `MakeBodyTree(…).joints`.
enum BodyTreeJoint {
  kTreeLeftToe,
  kTreeLeftAnkle,
  kTreeLeftKnee,
  kTreeLeftHip,
  kTreeNavel,
  kTreeLeftShoulder,
  kTreeLeftElbow,
  kTreeLeftWrist,
  kTreeRightShoulder,
  kTreeRightElbow,
  kTreeRightWrist,
  kTreeNeck,
  kTreeRightHip,
  kTreeRightKnee,
  kTreeRightAnkle,
  kBodyTreeJointCount
};

/// Returns paper B's body (figure 3.10): rooted at the left toe, 15 joints, 29 degrees of freedom,
/// limits `adult`, effectors right foot, left hand, right hand, head in this order. At rest (all angles zero) it
/// stands with hanging arms. *Ours*: its feet are level then; on real clips that keeps the ankles within their limits
/// most often.
KinematicTree MakeBodyTree(const LimbLengths& lengths);

/// The part of the canonical body that a limb of the tree is.
struct BodyTreeLimb {
  Role from;  ///< the joint that it turns about
  Role to;    ///< the joint that it leads to, or the end: the role of the effector on this limb
};

/// Returns the limbs of `MakeBodyTree(…).joints`, in the order of BodyTreeJoint.
std::span<const BodyTreeLimb, kBodyTreeJointCount> BodyTreeLimbs();

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
