#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_names.h"

namespace etude {

/// A limb of the canonical body.
struct Limb {
  std::array<Role, 3> roles;  ///< from the trunk outwards
  Role tip;
  Side side;
  bool is_arm;
};

inline constexpr std::array<Limb, 4> kLimbs = {{
    {{Role::kLeftShoulder, Role::kLeftElbow, Role::kLeftWrist}, Role::kLeftHand, Side::kLeft, true},
    {{Role::kRightShoulder, Role::kRightElbow, Role::kRightWrist}, Role::kRightHand, Side::kRight, true},
    {{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle}, Role::kLeftFoot, Side::kLeft, false},
    {{Role::kRightHip, Role::kRightKnee, Role::kRightAnkle}, Role::kRightFoot, Side::kRight, false},
}};
inline constexpr std::span<const Limb, 2> kLegs = std::span(kLimbs).last<2>();

/// The tree of a skeleton's joints, with their positions in the rest pose or in another pose that replaces it.
/// `skeleton` must outlive this object.
class SkeletonTree {
 public:
  explicit SkeletonTree(const Skeleton& skeleton) : SkeletonTree(skeleton, RestPose(skeleton)) {}
  SkeletonTree(const Skeleton& skeleton, const LocalPose& rest);

  int size() const { return static_cast<int>(rest_.size()); }
  const std::string& NameOf(int joint) const { return skeleton_.joints[joint].name; }
  int ParentOf(int joint) const { return skeleton_.joints[joint].parent; }
  const glm::dvec3& RestOf(int joint) const { return rest_[joint].position; }
  /// Returns true if `joint` is an end site by the file or by its name (EndSites).
  bool IsEnd(int joint) const { return ends_[joint]; }

  /// Returns true if `joint` is a descendant of `ancestor`; a joint is not a descendant of itself.
  bool DescendsFrom(int joint, int ancestor) const;
  /// Returns the lowest common ancestor of two joints, or −1.
  int CommonAncestor(int a, int b) const;
  /// Returns the position of `point` (given in the rest pose) in the joint's own frame; zero if that frame is singular.
  glm::dvec3 InFrameOf(int joint, const glm::dvec3& point) const;

 private:
  const Skeleton& skeleton_;
  std::vector<GlobalTransform> rest_;
  std::vector<bool> ends_;
};

/// A limb found by the names of its joints, which are listed from the trunk outwards; −1 for a missing joint.
struct FoundLimb {
  std::array<int, 3> joints{-1, -1, -1};
  std::string prefix;                 ///< the common prefix of the joints' names
  const LimbNames* scheme = nullptr;  ///< the scheme that names the most joints; null if none names any
};

/// Finds a limb by the first scheme whose three names, with one prefix, belong to a chain of descendants. As a second
/// choice, the third joint may be outside of the chain of the first two, because control rigs separate the feet from
/// the legs. If no scheme fits, returns the joints of the scheme that names the most joints. Joints in `taught` are
/// used as they are; −1 there means that the user did not give the joint.
FoundLimb FindLimb(const JointNames& names, const SkeletonTree& tree, std::span<const LimbNames> schemes, Side side,
                   const std::array<int, 3>& taught);

}  // namespace etude
