#include "engine/retargeting/skeleton_tree.h"

#include <algorithm>
#include <cmath>

namespace etude {

SkeletonTree::SkeletonTree(const Skeleton& skeleton) : skeleton_(skeleton) {
  ComputeGlobals(skeleton, RestPose(skeleton), rest_);
}

bool SkeletonTree::HangsFrom(int joint, int ancestor) const {
  if (joint == ancestor) return false;
  while (joint > ancestor) joint = ParentOf(joint);  // parents stand first
  return joint == ancestor;
}

int SkeletonTree::CommonAncestor(int a, int b) const {
  while (a != b) (a > b ? a : b) = ParentOf(std::max(a, b));
  return a;
}

glm::dvec3 SkeletonTree::InFrameOf(int joint, const glm::dvec3& point) const {
  const auto& [position, axes] = rest_[joint];
  if (!std::isnormal(glm::determinant(axes))) return glm::dvec3(0);
  const glm::dvec3 inside = glm::inverse(axes) * (point - position);
  const bool is_finite = std::isfinite(inside.x) && std::isfinite(inside.y) && std::isfinite(inside.z);
  return is_finite ? inside : glm::dvec3(0);
}

}  // namespace etude
