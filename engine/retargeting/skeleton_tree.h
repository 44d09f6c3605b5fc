#pragma once

#include <string>
#include <vector>

#include "engine/motion/clip.h"

namespace etude {

/// Who hangs from whom in a skeleton, and where the joints are in its rest pose. `skeleton` must outlive this.
class SkeletonTree {
 public:
  explicit SkeletonTree(const Skeleton& skeleton);

  int size() const { return static_cast<int>(rest_.size()); }
  const std::string& NameOf(int joint) const { return skeleton_.joints[joint].name; }
  int ParentOf(int joint) const { return skeleton_.joints[joint].parent; }
  const glm::dvec3& RestOf(int joint) const { return rest_[joint].position; }

  /// Whether `joint` hangs from `ancestor`, at whatever distance; a joint does not hang from itself.
  bool HangsFrom(int joint, int ancestor) const;
  /// The lowest joint that carries both, or −1.
  int CommonAncestor(int a, int b) const;
  /// `point` of the rest pose in the joint's own frame; zero when that frame has no size.
  glm::dvec3 InFrameOf(int joint, const glm::dvec3& point) const;

 private:
  const Skeleton& skeleton_;
  std::vector<GlobalTransform> rest_;
};

}  // namespace etude
