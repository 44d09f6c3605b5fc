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

/// A body that a motion is captured with: a tree, and what an observer sees of its parts.
struct CaptureBody {
  /// The part of an end effector that pictures show: the place of an end, the direction of the limb that leads to a
  /// role, or both.
  struct End {
    Role role;
    bool has_position = true;
    bool has_direction = true;
    double sense = 1;  ///< −1: the tree's limb runs against the stroke, which leads away from the trunk
  };
  /// The X axis of a limb that two of its neighbours tell: `bends` × (middle − upper) × (lower − middle).
  struct Twist {
    int joint;
    Role upper, middle, lower;
    double bends;
  };
  /// One joint of the body as a clip.
  struct ClipJoint {
    std::string name;
    int parent = -1;
    glm::dvec3 offset{0};  ///< from the parent at rest, metres
    int limb = 0;          ///< of the tree, with which it turns
    glm::dmat3 R_LC{1};    ///< its axes, which are the world's at rest, in that limb
    bool is_end = false;
  };

  bool is_paper = false;  ///< paper B's, which has rules of its own for lengths and start angles
  KinematicTree tree;     ///< rooted at the left toe, which is placed where it was seen
  std::array<TreePoint, kRoleCount> roles;
  /// True if hips turn against the pelvis, each on a joint of its own: the hip centre is then no point of a limb but
  /// midway between them.
  bool hips_turn = false;
  std::vector<End> ends;  ///< of each effector of the tree
  std::vector<Twist> twists;
  LimbLengths lengths;                      ///< as paper B counts them, means over both sides
  std::array<double, kRoleCount> bones{};   ///< of each role: from its parent's place, metres, at rest
  std::array<bool, kRoleCount> is_rigid{};  ///< of those: whether no joint lies in between
  std::vector<ClipJoint> skeleton;          ///< parents first; none of paper B's, which has its own `ToClip`
  TreePoint skeleton_root;                  ///< where its first joint is
};

/// Returns paper B's body (`MakeBodyTree`): 29 degrees of freedom, limits `adult`.
CaptureBody PaperBody(const LimbLengths& lengths);

/// Makes the person's own body: every joint of `rest` that lies between two of the twenty roles is a joint of the tree,
/// so that whatever the person does can be done by the tree. Rooted at the left toe, too, where the whole body turns
/// freely. *(Ours.)*
/// - Joints from which nothing leads anywhere are left out. A joint between the pelvis and a hip, as skeletons of depth
///   sensors have it, stays: `hips_turn`.
/// - A limb that carries one other, along its own line, has two degrees of freedom, which point it anywhere: what it
///   would turn about itself nobody sees. Three have the pelvis, limbs that carry several or whose points do not lie on
///   one line, and upper arms, the right thigh and the left shank: these turn elbows and knees into the plane in which
///   they bend.
/// - Joints turn freely: how far this person's can is not known. Only where no role shows how a joint bends (toes, the
///   middle of the neck) an angle is 90° at most.
/// Fails, saying why, for a body that has no pelvis, or two joints of a limb in one place.
Result<CaptureBody> FittedBody(const RestBody& rest);

/// Returns the twenty joints of a pose of the tree.
BodyPose ToBodyPose(const CaptureBody& body, const TreeState& state);
BodyPose ToBodyPose(const CaptureBody& body, const TreeFrames& frames);

/// Makes the problem that remains when a start is found: bring the ends back to where they were seen, the last limbs
/// into their seen directions, as far as `CaptureBody::ends` says that a limb has one. X and Y of the targets are the
/// start pose's, turned by the smallest rotation, and weigh nothing; so does all that `observation` lacks. Limits are
/// the tree's.
IkProblem MakeImageProblem(const CaptureBody& body, const LimbObservation& observation, const TreeState& start);

/// Returns a motion of the body as a clip of its own skeleton, metres, Y up, rooted at the hips. Exact: ComputeGlobals
/// gives every joint the position that `ToBodyPose` gives.
Clip ToClip(const CaptureBody& body, std::span<const TreeState> states, double rate_hz, const std::string& name);

}  // namespace etude
