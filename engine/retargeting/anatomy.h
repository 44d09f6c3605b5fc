#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/limb_finder.h"

namespace etude {

/// The limbs that a skeleton's build proposes, whatever its joints are called.
struct AnatomyProposal {
  /// Shoulders, elbows, wrists, hips, knees and ankles, by Index(role); −1 of all others, and of all where no two pairs
  /// of limbs were found.
  std::array<int, kRoleCount> joints;
  double confidence = 0;  ///< 0 to 1
};

/// A proposal may be used unasked from this confidence on.
constexpr double kSureAnatomy = 0.9;

/// Proposes the limbs by the shape of the tree and the rest pose (ours). Legs and arms are two pairs of brothers with
/// equally long chains of bones below them; the trunk leads from the legs to the arms, and legs lead the other way. In
/// each chain the three joints are those whose bones have the proportions of people's. Left is where up × forward
/// points, forward where the toes do; without toes the sides are as in a body that faces +Z, at little confidence.
/// The confidence is the product of how well each of these is met: 1 within the range of adults, falling off beyond.
AnatomyProposal ProposeByAnatomy(const SkeletonTree& tree);

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
