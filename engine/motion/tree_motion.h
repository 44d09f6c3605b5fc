#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// A joint tree with fixed offsets. Parents come before their children; joint 0 is the only root.
struct JointTree {
  std::vector<std::string> names;
  std::vector<int> parents;         ///< parent indices; −1 for joint 0
  std::vector<glm::dvec3> offsets;  ///< from the parent, in the parent's frame, metres; zero for joint 0
  std::vector<bool> is_point;       ///< true for joints without a rotation: end sites, and points that a reader added

  std::size_t size() const { return names.size(); }
  /// Returns true if both trees have the same joints below the same parents; offsets may differ.
  bool IsLike(const JointTree& other) const { return names == other.names && parents == other.parents; }
};

/// One frame of a tree: the root's position in the world, metres, and every joint's rotation relative to its parent
/// (unit quaternions; the root's rotation is relative to the world).
struct TreePose {
  glm::dvec3 root{0};
  std::vector<glm::dquat> turns;
};

/// The motion of a tree.
struct TreeMotion {
  JointTree tree;
  double rate_hz = 30;
  std::vector<TreePose> poses;
};

/// Converts a motion to rotations relative to the parents. The tree's offsets are taken from the first frame; later
/// changes of limb lengths are dropped. Joints that a reader has added (RawMotion::added) become points
/// (JointTree::is_point). Consecutive quaternions of a joint do not flip their signs. Fails for a motion without
/// rotations or frames, with positions that are not seen, or with several roots.
Result<TreeMotion> TreeMotionOf(const RawMotion& motion);

/// Appends the position (metres) and rotation of every joint in the world, for one pose.
void AppendGlobals(const JointTree& tree, const TreePose& pose, std::vector<glm::dvec3>& positions,
                   std::vector<glm::dquat>& turns);

/// Returns the rotation vector of a unit quaternion, radians; its length is at most π.
glm::dvec3 RotationVector(glm::dquat turn);
/// Returns the unit quaternion of a rotation vector.
glm::dquat TurnOf(const glm::dvec3& rotation_vector);

}  // namespace etude
