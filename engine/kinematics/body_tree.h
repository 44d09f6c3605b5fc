#pragma once

#include <array>
#include <span>
#include <string>

#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace [[gnu::visibility("default")]] etude {

/// Limb lengths of one person, metres, equal on both sides. The defaults describe an adult.
struct LimbLengths {
  double foot = 0.18;   ///< ankle to toe tips
  double shank = 0.42;  ///< knee to ankle
  double thigh = 0.43;  ///< hip to knee
  double hip_width = 0.18;
  double trunk = 0.50;           ///< navel (midway between the hips) to the base of the neck
  double neck = 0.25;            ///< base of the neck to the head
  double shoulder_width = 0.36;  ///< distance between the shoulders; the base of the neck is their midpoint
  double upper_arm = 0.29;
  double forearm = 0.25;
  double hand = 0.18;  ///< wrist to finger tips
};

/// A limb length and its name in files.
struct NamedLength {
  const char* name;
  double LimbLengths::*length;
};
inline constexpr std::array<NamedLength, 10> kLimbLengths = {{{"foot", &LimbLengths::foot},
                                                              {"shank", &LimbLengths::shank},
                                                              {"thigh", &LimbLengths::thigh},
                                                              {"hip_width", &LimbLengths::hip_width},
                                                              {"trunk", &LimbLengths::trunk},
                                                              {"neck", &LimbLengths::neck},
                                                              {"shoulder_width", &LimbLengths::shoulder_width},
                                                              {"upper_arm", &LimbLengths::upper_arm},
                                                              {"forearm", &LimbLengths::forearm},
                                                              {"hand", &LimbLengths::hand}}};
static_assert(sizeof(LimbLengths) == kLimbLengths.size() * sizeof(double), "every length is in the list");

/// Returns true if every length is finite and greater than zero.
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

/// Returns paper B's body (figure 3.10): rooted at the left toe, with 15 joints, 29 degrees of freedom, limits `adult`
/// and the effectors right foot, left hand, right hand, head, in this order. At rest (all angles zero) it stands with
/// hanging arms. *Ours*: the feet are level in the rest pose, because the ankles of real clips then stay within their
/// limits most often.
KinematicTree MakeBodyTree(const LimbLengths& lengths);

/// One limb of the tree, named by two roles of the canonical body.
struct BodyTreeLimb {
  Role from;  ///< the joint about which the limb turns
  Role to;    ///< the joint at the limb's far end; if the limb ends in an effector, the effector's role
};

/// Returns the limbs of `MakeBodyTree(…).joints`, in the order of BodyTreeJoint.
std::span<const BodyTreeLimb, kBodyTreeJointCount> BodyTreeLimbs();

/// Returns the twenty joints of a pose of paper B's body (`MakeBodyTree`). The hip centre is the navel; the spine is on
/// the line from navel to neck, at the fraction `kSpineShare`.
BodyPose ToBodyPose(const KinematicTree& body, const TreeState& state);

/// Returns a motion of paper B's body as a clip with its own skeleton: metres, Y up, rooted at the hips as other
/// programs expect. The skeleton's root has the pelvis's rotation. The tree's left leg runs from the toe up to the hip;
/// the skeleton's left leg runs from the hip down. The conversion is exact: ComputeGlobals gives every joint the
/// position that `ToBodyPose` gives. Joints have MotionBuilder's names, which FindJointMap knows; "LowerBack" coincides
/// with the hips and has the navel's rotation. At rest the skeleton stands with hanging arms, facing +Z.
Clip ToClip(const KinematicTree& body, std::span<const TreeState> states, double rate_hz, const std::string& name);

}  // namespace etude
