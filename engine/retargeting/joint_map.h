#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// A point that moves with a joint.
struct RolePoint {
  int joint = -1;
  glm::dvec3 offset{0};  ///< in the joint's frame, the file's unit; zero: the joint itself
};

/// The places of the twenty roles in a clip's own skeleton.
struct JointMap {
  std::array<RolePoint, kRoleCount> points;  ///< by Index(role)
  /// The roles that no joint or end site of the skeleton plays: points that ride on a neighbouring joint.
  std::vector<Role> composed;
  /// The roles that no name told, but the skeleton's build (ProposeByAnatomy), and how sure that is.
  std::vector<Role> by_anatomy = {};
  double confidence = 1;

  const RolePoint& operator[](Role role) const { return points[Index(role)]; }
};

struct TaughtRoles;

/// Finds the roles in a skeleton by the naming schemes of joint_names.h and by its build:
/// - shoulders, elbows, wrists, hips, knees, ankles, the base of the neck and the head by name; among
///   joints of one name those that hang together.
///   Wrists and ankles may hang from a control outside the limbs. Where no neck is named it
///   is *composed*: a point midway between the shoulders;
/// - the hip centre is midway between the hips, whatever the file's root is (paper B's P₁); its point
///   here names the joint that carries both hips, `Evaluate` puts it midway;
/// - the spine is the joint nearest to half the way from that joint to the base of the neck;
/// - hands, feet and head are tips: the farthest end of the chain (fingers, toes, skull) whose distance
///   from wrist, ankle or base of the neck is believable, else composed (ours): hand and head
///   straight on from forearm and trunk, foot forward, in the proportions of paper B's body. Files
///   carry end sites at 0 cm and at 1.6 m.
///
/// Where names fail, the build tells the limbs (anatomy.h), if it does so at a confidence of 0.9 and more and no role
/// that a name tells is another joint's by build.
///
/// Refused: missing limbs (listed with the names that are there), hips without a common joint, a knee not below its hip
/// and the like, hips not on opposite sides of the joint that carries them. Whether left is left shows when the body
/// moves (ToBodyMotion). `taught` roles are taken as they are, before any name is looked for, and checked like the
/// others; a joint that is not there is refused at its place in the joint-map file.
Result<JointMap> FindJointMap(const Skeleton& skeleton, const std::string& file, const TaughtRoles* taught = nullptr);

/// The findings about a skeleton whose roles are not all found.
struct PartialRoles {
  std::array<int, kRoleCount> found;     ///< joints by names, by Index(role); −1: none
  std::array<int, kRoleCount> proposed;  ///< by build, of limbs that names do not tell; −1: none
  double confidence = 0;                 ///< of what is proposed
};
PartialRoles FindRolesInPart(const Skeleton& skeleton);

/// The joint that a skeleton must be rooted at for its hips to carry its shoulders (WithRootAt): that of the hips where
/// a file is rooted at the chest or the head. −1 where nothing need change or no limbs are told by names.
int FindNewRoot(const Skeleton& skeleton);

/// Returns one frame of a clip as the twenty joints, in the file's unit and axes. `globals` is ComputeGlobals's output
/// for that frame.
BodyPose Evaluate(const JointMap& map, const std::vector<GlobalTransform>& globals);

}  // namespace etude
