#pragma once

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
  std::vector<bool> is_point;       ///< true for joints without a rotation: end sites, and points that a reader added

  std::size_t size() const { return names.size(); }
  /// Returns true if both have the same joints below the same parents; offsets may differ.
  bool IsLike(const JointTree& other) const { return names == other.names && parents == other.parents; }
};

/// One frame of a tree: its root's position in the world, metres, and every joint's rotation in its parent's frame
/// (unit quaternions; the root's in the world).
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

/// Converts a motion to rotations in the parents' frames. Offsets are those of the first frame; later changes are
/// dropped. Joints that are none of the file's own (RawMotion::added) are points. Quaternions keep their signs over
/// time. Fails for a motion without rotations or frames, with positions that are not seen, or with several roots.
Result<TreeMotion> TreeMotionOf(const RawMotion& motion);

/// Appends the positions (metres) and rotations of all joints in the world, in one frame.
void AppendGlobals(const JointTree& tree, const TreePose& pose, std::vector<glm::dvec3>& positions,
                   std::vector<glm::dquat>& turns);

/// Returns the rotation vector of a unit quaternion, radians; it is at most π long.
glm::dvec3 RotationVector(glm::dquat turn);
/// Returns the unit quaternion of a rotation vector.
glm::dquat TurnOf(const glm::dvec3& rotation_vector);

}  // namespace etude
