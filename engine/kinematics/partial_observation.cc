#include "engine/kinematics/partial_observation.h"

#include <algorithm>
#include <initializer_list>

#include "engine/base/directions.h"
#include "engine/base/euler.h"

namespace etude {
namespace {

using enum Role;

/// One arm or leg, from the trunk outwards.
struct Chain {
  Role root, middle, wrist, end;
};
constexpr Chain kLeftArmChain{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand};
constexpr Chain kRightArmChain{kRightShoulder, kRightElbow, kRightWrist, kRightHand};
constexpr Chain kLeftLegChain{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot};
constexpr Chain kRightLegChain{kRightHip, kRightKnee, kRightAnkle, kRightFoot};

class Completer {
 public:
  Completer(const LimbObservation& seen, const LimbLengths& lengths, const BodyPose& like)
      : lengths_(lengths), like_(like), whole_(seen) {}

  LimbObservation Complete() {
    for (const Chain& chain : {kLeftArmChain, kRightArmChain, kLeftLegChain, kRightLegChain}) {
      CompleteDirections({chain.middle, chain.wrist, chain.end});
    }
    CompleteDirections({kHead});
    const LimbPair legs{kLeftLegChain,  kRightLegChain, lengths_.hip_width,
                        lengths_.thigh, lengths_.shank, lengths_.foot};
    const LimbPair arms{kLeftArmChain,      kRightArmChain,   lengths_.shoulder_width,
                        lengths_.upper_arm, lengths_.forearm, lengths_.hand};
    const glm::dvec3 trunk = lengths_.trunk * UnitOr(like_[kShoulderCentre] - like_[kHipCentre], {0, 1, 0});
    const glm::dvec3 neck = lengths_.neck * Direction(kHead);
    const std::optional<glm::dvec3> seen_hips = MiddleOfRoots(legs), seen_shoulders = MiddleOfRoots(arms);
    const glm::dvec3 hips = seen_hips        ? *seen_hips
                            : seen_shoulders ? *seen_shoulders - trunk
                            : Lacks(kHead)   ? like_[kHipCentre]
                                             : whole_.ends[kHead] - neck - trunk;
    const glm::dvec3 shoulders = seen_shoulders.value_or(hips + trunk);
    PutEnds(legs, hips);
    PutEnds(arms, shoulders);
    if (Lacks(kHead)) whole_.ends[kHead] = shoulders + neck;
    return whole_;
  }

 private:
  /// Both arms, or both legs.
  struct LimbPair {
    Chain left, right;
    double width, upper, lower, last;
  };

  glm::dvec3 LimbOfLike(Role to) const { return UnitOr(like_[to] - like_[*ParentOf(to)], {0, -1, 0}); }
  glm::dvec3 Direction(Role to) const { return glm::normalize(whole_.directions[Index(to)]); }

  /// Of a chain, from the trunk outwards.
  void CompleteDirections(std::initializer_list<Role> limbs) {
    glm::dmat3 turn(1);  // of the limb before, from the pose that it is like
    for (const Role limb : limbs) {
      const glm::dvec3 before = LimbOfLike(limb);
      if (whole_.lacks_direction[Index(limb)]) {
        whole_.directions[Index(limb)] = turn * before;
      } else if (glm::length(whole_.directions[Index(limb)]) > 0) {
        turn = SmallestRotation(before, Direction(limb));
      }
    }
  }

  bool Lacks(Role end) const { return whole_.lacks_end[Index(end)]; }

  /// From the root of a chain to its end.
  glm::dvec3 Reach(const Chain& chain, const LimbPair& pair) const {
    return pair.upper * Direction(chain.middle) + pair.lower * Direction(chain.wrist) +
           pair.last * Direction(chain.end);
  }

  /// From the middle between both roots to the right one.
  glm::dvec3 HalfAcross(const LimbPair& pair) const {
    return 0.5 * pair.width * UnitOr(like_[pair.right.root] - like_[pair.left.root], {-1, 0, 0});
  }

  /// Where the ends that were seen put the middle between the roots.
  std::optional<glm::dvec3> MiddleOfRoots(const LimbPair& pair) const {
    const glm::dvec3 from_left = whole_.ends[pair.left.end] - Reach(pair.left, pair) + HalfAcross(pair);
    const glm::dvec3 from_right = whole_.ends[pair.right.end] - Reach(pair.right, pair) - HalfAcross(pair);
    const bool has_left = !Lacks(pair.left.end), has_right = !Lacks(pair.right.end);
    if (has_left && has_right) return 0.5 * (from_left + from_right);
    if (has_left) return from_left;
    if (has_right) return from_right;
    return std::nullopt;
  }

  void PutEnds(const LimbPair& pair, const glm::dvec3& middle) {
    if (Lacks(pair.left.end)) whole_.ends[pair.left.end] = middle - HalfAcross(pair) + Reach(pair.left, pair);
    if (Lacks(pair.right.end)) whole_.ends[pair.right.end] = middle + HalfAcross(pair) + Reach(pair.right, pair);
  }

  const LimbLengths& lengths_;
  const BodyPose& like_;
  LimbObservation whole_;
};

}  // namespace

std::optional<LimbObservation> CompleteObservation(const LimbObservation& seen, const LimbLengths& lengths,
                                                   const BodyPose& like, bool is_placed) {
  const auto lacks = [](const std::array<bool, kRoleCount>& roles) {
    return std::ranges::find(roles, true) != roles.end();
  };
  if (!lacks(seen.lacks_end) && !lacks(seen.lacks_direction)) return seen;
  constexpr std::array kLimbEnds = {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead};
  const bool is_seen = std::ranges::any_of(kLimbEnds, [&](Role end) { return !seen.lacks_end[Index(end)]; });
  if (!is_seen && !is_placed) return std::nullopt;
  return Completer(seen, lengths, like).Complete();
}

}  // namespace etude
