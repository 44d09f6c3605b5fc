#include "engine/retargeting/tips.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"
#include "engine/retargeting/joint_names.h"

namespace etude {
namespace {

using enum Role;

// Lengths of the tips relative to the neighbouring limb, from an adult's lengths in cm.
constexpr double kHandPerForearm = 18.0 / 25.0;
constexpr double kFootPerShank = 18.0 / 42.0;
constexpr double kHeadPerTrunk = 25.0 / 50.0;

/// The plausible range of a tip's length, in multiples of the length that follows from the proportions above.
struct TipLength {
  double shortest;
  double longest;
};
// In CMU's files, the fingers end at half the length of a hand of these proportions.
constexpr TipLength kPlausibleHand{0.4, 1.6};
// The feet of the clip Boxing_Toes are 1.4 times as long as paper B's, the feet of KayKit's toy figures 2.6 times.
constexpr TipLength kPlausibleFoot{0.4, 3.0};
// A skeleton's only head joint often lies at the base of the skull, 0.2 trunk lengths above the neck. The lower limit,
// 0.25 trunk lengths, excludes it.
constexpr TipLength kPlausibleHead{0.5, 1.6};

// Tips count as equally far if their distances differ by less than this share, because files may have only six
// decimals, in metres.
constexpr double kEquallyFar = 1e-4;

/// Returns the finger to which a joint below `top` belongs, by the joint's name or, if that names no finger, by the
/// name of the nearest ancestor that does. End sites have no names of their own.
Finger FingerBelow(const SkeletonTree& tree, int joint, int top) {
  for (; joint != top; joint = tree.ParentOf(joint)) {
    const Finger finger = FingerOf(tree.NameOf(joint));
    if (finger != Finger::kNotNamed) return finger;
  }
  return Finger::kNotNamed;
}

/// Returns the farthest joint among `top` and its descendants that is at a plausible `distance` and for which `may_be`
/// is true. Of equally far joints, returns the one with the most suitable finger name, then the first in the skeleton.
/// Without this rule, rounding could choose different fingers on the left and on the right.
template <typename Distance, typename MayBe>
std::optional<int> FarthestTip(const SkeletonTree& tree, int top, double proportion, const TipLength& plausible,
                               Distance distance_of, MayBe may_be) {
  struct Tip {
    int joint;
    double distance;
  };
  std::vector<Tip> tips;
  double longest = 0;
  for (int i = top; i < tree.size(); ++i) {
    if (i != top && !tree.DescendsFrom(i, top)) continue;
    const double distance = distance_of(i);
    const bool is_plausible = distance >= plausible.shortest * proportion && distance <= plausible.longest * proportion;
    if (!is_plausible || !may_be(i)) continue;
    tips.push_back({i, distance});
    longest = std::max(longest, distance);
  }
  if (longest == 0) return std::nullopt;
  std::erase_if(tips, [&](const Tip& tip) { return tip.distance < (1 - kEquallyFar) * longest; });
  return std::ranges::min_element(tips, {}, [&](const Tip& tip) { return FingerBelow(tree, tip.joint, top); })->joint;
}

/// The body in one pose of the clip, with the positions of its roles.
class PosedBody {
 public:
  PosedBody(const JointMapDraft& draft, const std::vector<GlobalTransform>& joints) : draft_(draft), joints_(joints) {}

  glm::dvec3 At(Role role) const {
    const RolePoint& point = draft_.map()[role];
    return Placed(point.joint, point.offset);
  }
  glm::dvec3 JointAt(int joint) const { return joints_[joint].position; }
  glm::dvec3 Placed(int joint, const glm::dvec3& offset) const {
    return joints_[joint].position + joints_[joint].axes * offset;
  }
  glm::dvec3 Trunk() const { return At(kShoulderCentre) - 0.5 * (At(kLeftHip) + At(kRightHip)); }
  glm::dvec3 Forward() const {
    return glm::cross(At(kLeftHip) - At(kRightHip), At(kShoulderCentre) - At(kHipCentre));
  }
  /// Returns a point in a joint's own frame; zero if that frame is singular.
  glm::dvec3 InFrameOf(int joint, const glm::dvec3& point) const {
    const auto& [position, axes] = joints_[joint];
    return std::isnormal(glm::determinant(axes)) ? glm::inverse(axes) * (point - position) : glm::dvec3(0);
  }

 private:
  const JointMapDraft& draft_;
  const std::vector<GlobalTransform>& joints_;
};

template <typename Measure>
double MedianOf(const JointMapDraft& draft, const MovingPoses& moving, Measure measure) {
  std::vector<double> values;
  for (const std::vector<GlobalTransform>& joints : moving) values.push_back(measure(PosedBody(draft, joints)));
  return LowerPercentile(std::move(values), 0.5);
}

/// Makes the role `tip` a point that is fixed to `joint`, at the distance `length` from the role `base`. `direction`
/// returns the direction from `base` to the tip in a pose. `rest` is the tip's position in the rest pose.
template <typename Direction>
void ComposeTip(JointMapDraft& draft, Role tip, int joint, Role base, const glm::dvec3& rest, double length,
                const MovingPoses& moving, Direction direction) {
  // Hands bend by 90° in push-ups. Feet have no such limit, because the feet of people who kneel or lie point in any
  // direction relative to the body.
  constexpr double kHeadElsewhere = Radians(60), kHandElsewhere = Radians(100);
  const double elsewhere = tip == kHead ? kHeadElsewhere : kHandElsewhere;
  const bool is_foot = tip == kLeftFoot || tip == kRightFoot;
  const glm::dvec3 offset = draft.tree().InFrameOf(joint, rest);
  const auto off = [&](const PosedBody& body) {
    const glm::dvec3 wanted = body.At(base) + length * UnitOr(direction(body), glm::dvec3(0));
    return AngleBetween(body.Placed(joint, offset) - body.JointAt(joint), wanted - body.JointAt(joint));
  };
  if (is_foot || moving.empty() || MedianOf(draft, moving, off) <= elsewhere) {
    return draft.Compose(tip, joint, rest);
  }
  glm::dvec3 sum(0);
  for (const std::vector<GlobalTransform>& joints : moving) {
    const PosedBody body(draft, joints);
    sum += body.InFrameOf(joint, body.At(base) + length * UnitOr(direction(body), glm::dvec3(0)));
  }
  draft.ComposeAt(tip, joint, sum / static_cast<double>(moving.size()), rest);
}

glm::dvec3 RestForward(const JointMapDraft& draft) {
  return glm::cross(draft.RestOf(kLeftHip) - draft.RestOf(kRightHip),
                    draft.RestOf(kShoulderCentre) - draft.RestOf(kHipCentre));
}

void FindLimbTip(JointMapDraft& draft, const Limb& limb, const MovingPoses& moving) {
  const auto [upper, middle, last] = limb.roles;
  const glm::dvec3 end = draft.RestOf(last);
  const glm::dvec3 last_bone = end - draft.RestOf(middle);
  const double length = glm::length(last_bone) * (limb.is_arm ? kHandPerForearm : kFootPerShank);
  // A joint that hangs from a separate control is not a part of the body.
  if (!IsFree(draft, last)) {
    const TipLength& plausible = limb.is_arm ? kPlausibleHand : kPlausibleFoot;
    const int top = draft.JointOf(last);
    const auto is_no_thumb = [&](int joint) { return FingerBelow(draft.tree(), joint, top) != Finger::kThumb; };
    const auto at_rest = [&](int joint) { return glm::distance(draft.tree().RestOf(joint), end); };
    auto tip = FarthestTip(draft.tree(), top, length, plausible, at_rest, is_no_thumb);
    // In motion another joint may be farther, for example toes that are folded back at rest. Hands with a tip at rest
    // are not searched again, because fingers curl.
    if ((!tip || !limb.is_arm) && !moving.empty()) {
      constexpr double kFarther = 1.2;
      const auto in_motion = [&, last = last](int joint) {
        return MedianOf(draft, moving,
                        [&](const PosedBody& body) { return glm::distance(body.JointAt(joint), body.At(last)); });
      };
      const auto other = FarthestTip(draft.tree(), top, length, plausible, in_motion, is_no_thumb);
      if (other && (!tip || in_motion(*other) > kFarther * in_motion(*tip))) tip = other;
    }
    if (tip) return draft.Set(limb.tip, *tip);
  }
  const glm::dvec3 direction = limb.is_arm ? last_bone : RestForward(draft);
  const double size = glm::length(direction);
  ComposeTip(draft, limb.tip, draft.JointOf(last), last, size > 0 ? end + direction * (length / size) : end, length,
             moving, [&, middle = middle, last = last](const PosedBody& body) {
               return limb.is_arm ? body.At(last) - body.At(middle) : body.Forward();
             });
}

void FindHeadTip(JointMapDraft& draft, const MovingPoses& moving) {
  const glm::dvec3 neck = draft.RestOf(kShoulderCentre);
  const glm::dvec3 trunk = neck - 0.5 * (draft.RestOf(kLeftHip) + draft.RestOf(kRightHip));
  const double length = glm::length(trunk) * kHeadPerTrunk;
  const glm::dvec3 above = neck + trunk * kHeadPerTrunk;
  const auto trunk_of = [](const PosedBody& body) { return body.Trunk(); };
  if (!draft.Has(kHead)) {
    return ComposeTip(draft, kHead, draft.JointOf(kShoulderCentre), kShoulderCentre, above, length, moving, trunk_of);
  }
  const int head = draft.JointOf(kHead);
  // Eyes, jaws and ears also descend from the head, but lie in front of it or beside it, while the crown continues the
  // trunk.
  constexpr double kAside = Radians(30), kAsideInMotion = Radians(45), kUnlike = Radians(25);
  const auto is_straight_on = [&](int joint) {
    return joint == head || AngleBetween(draft.tree().RestOf(joint) - draft.RestOf(kHead), trunk) <= kAside;
  };
  const auto at_rest = [&](int joint) { return glm::distance(draft.tree().RestOf(joint), neck); };
  auto tip = FarthestTip(draft.tree(), head, length, kPlausibleHead, at_rest, is_straight_on);
  if (!tip && !moving.empty()) {
    const auto in_motion = [&](int joint) {
      return MedianOf(draft, moving, [&](const PosedBody& body) {
        return glm::distance(body.JointAt(joint), body.At(kShoulderCentre));
      });
    };
    // An eye or ear lies beside the trunk's line at rest and in motion. The crown lies beside this line at rest only
    // if the rest pose is not a human pose; in motion, its angle to the line is then much smaller.
    const auto is_on_in_motion = [&](int joint) {
      const double rest_angle = AngleBetween(draft.tree().RestOf(joint) - draft.RestOf(kHead), trunk);
      const double angle = MedianOf(draft, moving, [&](const PosedBody& body) {
        return AngleBetween(body.JointAt(joint) - body.JointAt(head), body.Trunk());
      });
      return joint == head || (angle <= kAsideInMotion && rest_angle - angle > kUnlike);
    };
    tip = FarthestTip(draft.tree(), head, length, kPlausibleHead, in_motion, is_on_in_motion);
  }
  if (tip) return draft.Set(kHead, *tip);
  ComposeTip(draft, kHead, head, kShoulderCentre, above, length, moving, trunk_of);
}

}  // namespace

void FindTips(JointMapDraft& draft, const std::array<bool, kRoleCount>& is_taught, const MovingPoses& moving) {
  for (const Limb& limb : kLimbs) {
    if (!is_taught[Index(limb.tip)]) FindLimbTip(draft, limb, moving);
  }
  if (!is_taught[Index(kHead)]) FindHeadTip(draft, moving);
}

}  // namespace etude
