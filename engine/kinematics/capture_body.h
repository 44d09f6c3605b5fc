#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/motion/rest_body.h"

namespace etude {

/// The body model of a capture: a kinematic tree, and what pictures show of the tree's limbs.
struct CaptureBody {
  /// The quantities of an end effector that pictures show: its position, the direction of its last limb, or both.
  struct End {
    Role role;
    bool has_position = true;
    bool has_direction = true;
    double sense = 1;  ///< −1 if the tree's limb points inwards and the annotator's stroke outwards; else 1
  };
  /// The twist of a limb, given by two neighbouring limbs. `bends` is 1 or −1. The limb's X axis points along
  /// `bends` · (middle − upper) × (lower − middle).
  struct Twist {
    int joint;
    Role upper, middle, lower;
    double bends;
  };
  /// One joint of the skeleton that `ToClip` writes.
  struct ClipJoint {
    std::string name;
    int parent = -1;
    glm::dvec3 offset{0};  ///< position relative to the parent in the rest pose, metres
    int limb = 0;          ///< the limb of the tree to which this joint is fixed
    glm::dmat3 R_LC{1};    ///< the joint's axes in that limb; at rest they are the world's axes
    bool is_end = false;
  };

  bool is_paper = false;  ///< true for paper B's body, which has its own rules for lengths and start angles
  KinematicTree tree;     ///< its root is the left toe, which is put at the toe's observed position
  std::array<TreePoint, kRoleCount> roles;
  /// True if each hip turns relative to the pelvis by a joint of its own. The hip centre is then the midpoint of both
  /// hips and not a point of a limb.
  bool hips_turn = false;
  std::vector<End> ends;  ///< one per effector of the tree
  std::vector<Twist> twists;
  LimbLengths lengths;                      ///< the limb lengths of paper B's body; each is the mean of left and right
  std::array<double, kRoleCount> bones{};   ///< for each role, the distance from its parent role at rest, metres
  std::array<bool, kRoleCount> is_rigid{};  ///< for each role: true if no joint lies between role and parent role
  std::vector<ClipJoint> skeleton;          ///< parents first; empty for paper B's body, which has its own `ToClip`
  TreePoint skeleton_root;                  ///< the position of the first joint of `skeleton`
};

/// Returns paper B's body (`MakeBodyTree`): 29 degrees of freedom, limits `adult`.
CaptureBody PaperBody(const LimbLengths& lengths);

/// Makes a body for one person from a rest pose: every joint of `rest` that lies between two of the twenty roles
/// becomes a joint of the tree, so the tree can follow everything the person does. The tree is rooted at the left toe,
/// where the whole body turns freely. *(Ours.)*
/// - A joint is left out if no role lies beyond it. A joint between the pelvis and a hip, as in skeletons of depth
///   sensors, is kept (`hips_turn`).
/// - A limb has two degrees of freedom if its only child lies on the limb's line: two angles point the limb in any
///   direction, and pictures do not show its rotation about this line.
/// - These limbs have three degrees of freedom: the pelvis, limbs with several children, limbs whose points do not lie
///   on one line, and the upper arms, the right thigh and the left shank, whose rotation turns the plane in which elbow
///   or knee bends.
/// - Joints turn freely, because the range of this person's joints is unknown. Only angles of joints that coincide with
///   no role (toes, the middle of the neck) are limited, to ±90°.
/// Fails with a reason if a role is not connected to the pelvis or a limb has no length.
Result<CaptureBody> FittedBody(const RestBody& rest);

/// Returns the twenty joints of the body in the pose `state`.
BodyPose ToBodyPose(const CaptureBody& body, const TreeState& state);
BodyPose ToBodyPose(const CaptureBody& body, const TreeFrames& frames);

/// Makes the inverse-kinematics problem whose start pose is `start`: move the end effectors back to their observed
/// positions, and point the last limbs in their observed directions if `CaptureBody::ends` gives them a direction. The
/// X and Y axes of such a target have weight 0; they are the start pose's axes, turned by the smallest rotation to that
/// direction. Positions and directions that `observation` lacks have weight 0. The problem has the tree's limits.
IkProblem MakeImageProblem(const CaptureBody& body, const LimbObservation& observation, const TreeState& start);

/// Returns a motion of the body as a clip with its own skeleton: metres, Y up, rooted at the hips. The conversion is
/// exact: ComputeGlobals gives every joint the position that `ToBodyPose` gives.
Clip ToClip(const CaptureBody& body, std::span<const TreeState> states, double rate_hz, const std::string& name);

}  // namespace etude
