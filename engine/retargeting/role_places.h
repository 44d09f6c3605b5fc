#pragma once

#include <array>

#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/skeleton_tree.h"

namespace etude {

/// A joint map while it is being found, and where its roles are in the rest pose. `tree` must outlive this.
class RolePlaces {
 public:
  explicit RolePlaces(const SkeletonTree& tree) : tree_(tree) {}

  const SkeletonTree& tree() const { return tree_; }
  const JointMap& map() const { return map_; }

  bool Has(Role role) const { return JointOf(role) >= 0; }
  bool IsComposed(Role role) const;
  int JointOf(Role role) const { return map_[role].joint; }
  const std::string& NameOf(Role role) const { return tree_.NameOf(JointOf(role)); }
  const glm::dvec3& RestOf(Role role) const { return rest_[Index(role)]; }

  /// The joint itself plays the role.
  void Set(Role role, int joint);
  /// A point fixed to `joint`, at `rest` in the rest pose, plays the role.
  void Compose(Role role, int joint, const glm::dvec3& rest);

 private:
  const SkeletonTree& tree_;
  JointMap map_;
  std::array<glm::dvec3, kRoleCount> rest_{};
};

}  // namespace etude
