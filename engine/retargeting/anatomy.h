#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/limb_finder.h"

namespace etude {

/// The limbs that a skeleton's shape suggests, independently of its joints' names.
struct AnatomyProposal {
  /// By Index(role): the skeleton's joints for shoulders, elbows, wrists, hips, knees and ankles; −1 for all other
  /// roles. If legs or arms were not found, all are −1.
  std::array<int, kRoleCount> joints;
  double confidence = 0;  ///< 0 to 1
};

/// A proposal with at least this confidence may be used without confirmation.
constexpr double kMinAnatomyConfidence = 0.9;

/// Proposes the limbs from the topology of the tree and the rest pose (ours). Legs and arms are two pairs of siblings;
/// the two chains of bones below a pair are equally long. The trunk leads from the legs to the arms, and the legs point
/// away from the trunk. In each chain, the three joints are chosen so that the bones between them have human
/// proportions. Left is the direction up × forward, where forward is the direction of the toes. Without toes, the
/// body is assumed to face +Z, with a lower confidence. The confidence is the product of one score per criterion; a
/// score is 1 within the range of adults and decreases outside. A second choice that fits as well halves the
/// confidence.
AnatomyProposal ProposeByAnatomy(const SkeletonTree& tree);

/// A joint map under construction, with the positions of the assigned roles in the rest pose. `tree` must outlive this
/// object.
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

  /// Assigns `joint` to the role.
  void Set(Role role, int joint);
  /// Assigns to the role a point that is fixed to `joint`. `rest` is the point's position in the rest pose.
  void Compose(Role role, int joint, const glm::dvec3& rest);
  /// Assigns to the role a point that is fixed to `joint`. `offset` is the point's position in the joint's frame,
  /// `rest` the point's position in the rest pose.
  void ComposeAt(Role role, int joint, const glm::dvec3& offset, const glm::dvec3& rest);

 private:
  const SkeletonTree& tree_;
  JointMap map_;
  std::array<glm::dvec3, kRoleCount> rest_{};
};

/// Returns true if the joint that plays the role `end` belongs to no limb. If the role is a wrist or an ankle, a
/// separate control of the rig then moves this joint.
bool IsFree(const JointMapDraft& draft, Role end);

}  // namespace etude
