#pragma once

#include <array>

#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/limb_finder.h"

namespace etude {

/// A joint map while it is being found, and where its roles are in the rest pose. `tree` must outlive this.
class JointMapDraft {
 public:
  explicit JointMapDraft(const SkeletonTree& tree) : tree_(tree) {}

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

/// Finds hands, feet and head that are not taught, when all other roles have their places: the farthest descendant of
/// wrist, ankle and head at a believable distance, else composed in the proportions of paper B's body. No thumb is the
/// tip of a hand; of equally far tips (within 10⁻⁴) the middle finger is taken, then index, ring and little finger,
/// then the skeleton's first, on the left as on the right. A head joint that was found by name stands in the head's
/// role; it becomes the tip's carrier.
void FindTips(JointMapDraft& places, const std::array<bool, kRoleCount>& is_taught);

/// Says whether a wrist or ankle is moved by a control of its own instead of by any limb.
bool IsFree(const JointMapDraft& places, Role end);

}  // namespace etude
