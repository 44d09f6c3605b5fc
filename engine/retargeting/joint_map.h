#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// A point that is fixed to a joint.
struct RolePoint {
  int joint = -1;
  glm::dvec3 offset{0};  ///< position in the joint's frame, in the file's unit; zero means the joint itself
};

/// The points of a clip's own skeleton that play the twenty roles.
struct JointMap {
  std::array<RolePoint, kRoleCount> points;  ///< one per role, by Index(role)
  /// The roles that no joint or end site of the skeleton plays. Their points are fixed to a neighbouring joint.
  std::vector<Role> composed;
  /// The roles that were found by the skeleton's shape (ProposeByAnatomy) instead of by name, and the confidence of
  /// that proposal.
  std::vector<Role> by_anatomy = {};
  double confidence = 1;

  const RolePoint& operator[](Role role) const { return points[Index(role)]; }
};

struct JointMapOverrides;

/// Finds the roles in a skeleton by the naming schemes of joint_names.h and by its shape:
/// - Shoulders, elbows, wrists, hips, knees, ankles, the base of the neck and the head are found by name. If several
///   joints have a name, the joints that form a chain are taken. Wrists and ankles may descend from a control outside
///   of the limbs. If no neck is named, it is *composed*: a point midway between the shoulders.
/// - The hip centre is midway between the hips, wherever the file's root is (paper B's P₁). The map contains the hips'
///   lowest common ancestor; `Evaluate` computes the midpoint.
/// - The spine is the joint nearest to the middle of the chain from the hips' common ancestor to the base of the neck.
/// - Hands, feet and head are tips: each is the farthest end of its chain (fingers, toes, skull) at a plausible
///   distance from wrist, ankle or base of the neck, because files contain end sites at 0 cm and at 1.6 m. If no end
///   is at a plausible distance, the tip is composed (ours) in the proportions of paper B's body: the hand extends the
///   forearm, the head extends the trunk, and the foot points forward.
///
/// If names fail, the limbs follow from the shape (anatomy.h). The proposal must have a confidence of at least 0.9 and
/// must not contradict a role that was found by name.
///
/// Poses of `frames` are used if the rest pose is not a human pose. If the rest pose's legs do not point away from the
/// trunk, the most upright frame replaces this pose; tips that are implausible at rest are searched in motion
/// (FindTips). The roles in `taught` are assigned before any name is searched, and checked like the others.
///
/// Fails if a limb is missing (the message lists the file's names), if the hips have no common ancestor or are not on
/// opposite sides of it, if a joint does not descend from the previous joint of its limb (a knee from its hip), if the
/// joint of the spine, neck or head is part of a limb, or if a joint of `taught` does not exist (the message names its
/// line in the joint-map file). ToBodyMotion checks on the moving body that left and right are not exchanged.
Result<JointMap> FindJointMap(const Skeleton& skeleton, const std::string& file,
                              const JointMapOverrides* taught = nullptr, std::span<const LocalPose> frames = {});

/// The roles found in a skeleton, even if some are missing.
struct PartialRoles {
  std::array<int, kRoleCount> found;     ///< joints found by name, by Index(role); −1: none
  std::array<int, kRoleCount> proposed;  ///< joints found by shape, for limbs without names, by Index(role); −1: none
  double confidence = 0;                 ///< the confidence of `proposed`
};
PartialRoles FindPartialRoles(const Skeleton& skeleton);

/// Returns the joint that must become the root (WithRootAt) if the file is rooted at the chest or the head: the hips'
/// common ancestor, which then becomes an ancestor of the shoulders. Returns −1 if no change is needed, or if limbs
/// have no known names.
int FindNewRoot(const Skeleton& skeleton);

/// Returns one frame of a clip as the twenty joints, in the file's unit and axes. `globals` is the output of
/// ComputeGlobals for that frame.
BodyPose Evaluate(const JointMap& map, const std::vector<GlobalTransform>& globals);

}  // namespace etude
