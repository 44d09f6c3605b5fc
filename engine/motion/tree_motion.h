#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// A joint tree with fixed offsets. Parents come before their children; joint 0 is the only root.
struct JointTree {
  std::vector<std::string> names;
  std::vector<int> parents;         ///< of joint 0: −1
  std::vector<glm::dvec3> offsets;  ///< from the parent, in its frame, metres; zero for joint 0
  std::vector<bool> is_point;  ///< joints without a rotation of their own: end sites, and points that a reader added

  std::size_t size() const { return names.size(); }
  /// Returns true if both have the same joints below the same parents; offsets may differ.
  bool IsLike(const JointTree& other) const { return names == other.names && parents == other.parents; }
};

/// One frame of a tree: where its root is, metres, and every joint's rotation in its parent's frame.
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

/// Returns a motion as rotations in the parents' frames, with the offsets of its first frame: later changes of them are
/// left out. `points` are the names of joints without a rotation of their own. Signs of quaternions are continuous in
/// time. Fails for a motion without rotations, without frames, with
/// positions that are not seen, or with two roots.
Result<TreeMotion> TreeMotionOf(const RawMotion& motion, const std::set<std::string>& points);

/// Appends the positions and global rotations of all joints in one frame.
void AppendGlobals(const JointTree& tree, const TreePose& pose, std::vector<glm::dvec3>& positions,
                   std::vector<glm::dquat>& turns);

/// Returns the rotation vector of a unit quaternion, radians, at most π long, and the unit quaternion of one.
glm::dvec3 RotationVector(glm::dquat turn);
glm::dquat TurnOf(const glm::dvec3& rotation_vector);

}  // namespace etude
