#include "engine/retargeting/tips.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/retargeting/joint_names.h"
#include "engine/retargeting/limbs.h"

namespace etude {

bool JointMapDraft::IsComposed(Role role) const {
  return std::ranges::find(map_.composed, role) != map_.composed.end();
}

void JointMapDraft::Set(Role role, int joint) {
  map_.points[Index(role)] = {.joint = joint};
  rest_[Index(role)] = tree_.RestOf(joint);
}

void JointMapDraft::Compose(Role role, int joint, const glm::dvec3& rest) {
  map_.points[Index(role)] = {.joint = joint, .offset = tree_.InFrameOf(joint, rest)};
  rest_[Index(role)] = rest;
  map_.composed.push_back(role);
}

namespace {

using enum Role;

// Tips relative to the limb they end (an adult's, cm).
constexpr double kHandPerForearm = 18.0 / 25.0;
constexpr double kFootPerShank = 18.0 / 42.0;
constexpr double kHeadPerTrunk = 25.0 / 50.0;

/// The range in which a tip's length is believed, relative to the proportion above.
struct TipLength {
  double shortest;
  double longest;
};
// CMU's fingers are half as long as a hand.
constexpr TipLength kBelievedHand{0.4, 1.6};
// Boxing_Toes' feet are 1.4 times as long as paper B's, KayKit's toys stand on feet of 2.6 times that.
constexpr TipLength kBelievedFoot{0.4, 3.0};
// A lone "Head" joint lies at the skull's base, at 0.2 of the trunk.
constexpr TipLength kBelievedHead{0.5, 1.6};

// Tips as far as that from each other are equally far: files print six decimals, also of metres.
constexpr double kEquallyFar = 1e-4;

/// The finger that a joint below `top` belongs to: its own name's, else that of the next joint above it that is named
/// so. End sites have no names of their own.
Finger FingerBelow(const SkeletonTree& tree, int joint, int top) {
  for (; joint != top; joint = tree.ParentOf(joint)) {
    const Finger finger = FingerOf(tree.NameOf(joint));
    if (finger != Finger::kNotNamed) return finger;
  }
  return Finger::kNotNamed;
}

/// The farthest descendant of `top` (or `top` itself) from `base` at a believable distance, of those that `may_be` it.
/// Of several equally far ones that of the longest finger by name, else the skeleton's first: rounding would choose
/// another one on the left than on the right.
template <typename MayBe>
std::optional<int> FarthestTip(const SkeletonTree& tree, int top, const glm::dvec3& base, double proportion,
                               const TipLength& believed, MayBe may_be) {
  struct Tip {
    int joint;
    double distance;
  };
  std::vector<Tip> tips;
  double longest = 0;
  for (int i = top; i < tree.size(); ++i) {
    const double distance = glm::distance(tree.RestOf(i), base);
    const bool is_believed = distance >= believed.shortest * proportion && distance <= believed.longest * proportion;
    if (!is_believed || (i != top && !tree.HangsFrom(i, top)) || !may_be(i)) continue;
    tips.push_back({i, distance});
    longest = std::max(longest, distance);
  }
  if (longest == 0) return std::nullopt;
  std::erase_if(tips, [&](const Tip& tip) { return tip.distance < (1 - kEquallyFar) * longest; });
  return std::ranges::min_element(tips, {}, [&](const Tip& tip) { return FingerBelow(tree, tip.joint, top); })->joint;
}

glm::dvec3 RestForward(const JointMapDraft& places) {
  return glm::cross(places.RestOf(kLeftHip) - places.RestOf(kRightHip),
                    places.RestOf(kShoulderCentre) - places.RestOf(kHipCentre));
}

void FindLimbTip(JointMapDraft& places, const Limb& limb) {
  const auto [upper, middle, last] = limb.roles;
  const glm::dvec3 end = places.RestOf(last);
  const glm::dvec3 last_bone = end - places.RestOf(middle);
  const double length = glm::length(last_bone) * (limb.is_arm ? kHandPerForearm : kFootPerShank);
  // What hangs from a control is no part of the body.
  if (!IsFree(places, last)) {
    const TipLength& believed = limb.is_arm ? kBelievedHand : kBelievedFoot;
    const int top = places.JointOf(last);
    const auto is_no_thumb = [&](int joint) { return FingerBelow(places.tree(), joint, top) != Finger::kThumb; };
    const auto tip = FarthestTip(places.tree(), top, end, length, believed, is_no_thumb);
    if (tip) return places.Set(limb.tip, *tip);
  }
  const glm::dvec3 direction = limb.is_arm ? last_bone : RestForward(places);
  const double size = glm::length(direction);
  places.Compose(limb.tip, places.JointOf(last), size > 0 ? end + direction * (length / size) : end);
}

void FindHeadTip(JointMapDraft& places) {
  const glm::dvec3 neck = places.RestOf(kShoulderCentre);
  const glm::dvec3 trunk = neck - 0.5 * (places.RestOf(kLeftHip) + places.RestOf(kRightHip));
  if (!places.Has(kHead)) return places.Compose(kHead, places.JointOf(kShoulderCentre), neck + trunk * kHeadPerTrunk);
  const int head = places.JointOf(kHead);
  // Eyes, jaws and ears hang from the head too, but forward or aside: the crown is straight on from the trunk.
  constexpr double kAside = Radians(30);
  const auto is_straight_on = [&](int joint) {
    return joint == head || AngleBetween(places.tree().RestOf(joint) - places.RestOf(kHead), trunk) <= kAside;
  };
  const auto tip =
      FarthestTip(places.tree(), head, neck, glm::length(trunk) * kHeadPerTrunk, kBelievedHead, is_straight_on);
  if (tip) return places.Set(kHead, *tip);
  places.Compose(kHead, head, neck + trunk * kHeadPerTrunk);
}

}  // namespace

void FindTips(JointMapDraft& places, const std::array<bool, kRoleCount>& is_taught) {
  for (const Limb& limb : kLimbs) {
    if (!is_taught[Index(limb.tip)]) FindLimbTip(places, limb);
  }
  if (!is_taught[Index(kHead)]) FindHeadTip(places);
}

bool IsFree(const JointMapDraft& places, Role end) {
  const int joint = places.JointOf(end);
  return std::ranges::none_of(kLimbs, [&](const Limb& limb) {
    const int top = places.JointOf(limb.roles[0]);
    return joint == top || places.tree().HangsFrom(joint, top);
  });
}

}  // namespace etude
