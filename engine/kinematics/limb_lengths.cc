#include "engine/kinematics/limb_lengths.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>

#include "engine/base/directions.h"
#include "engine/base/euler.h"

namespace etude {
namespace {

using enum Role;

constexpr std::array<Role, 13> kObserved = {kHead,       kLeftElbow,  kLeftWrist, kLeftHand,  kRightElbow,
                                            kRightWrist, kRightHand,  kLeftKnee,  kLeftAnkle, kLeftFoot,
                                            kRightKnee,  kRightAnkle, kRightFoot};
constexpr std::array<Role, 5> kEnds = {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead};
constexpr std::array<Role, 4> kLeftArm = {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand};
constexpr std::array<Role, 4> kRightArm = {kRightShoulder, kRightElbow, kRightWrist, kRightHand};
constexpr std::array<Role, 4> kRightLeg = {kRightHip, kRightKnee, kRightAnkle, kRightFoot};

// Two points nearer than this define no direction.
constexpr double kMinGapM = 1e-6;

bool IsFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool IsUsable(const LimbObservation& observation) {
  for (Role end : kEnds) {
    if (!IsFinite(observation.ends[end])) return false;
  }
  for (Role limb : kObserved) {
    const double length = glm::length(observation.directions[Index(limb)]);
    if (!std::isfinite(length) || length <= 0) return false;
  }
  return true;
}

// Builds one limb chain of paper B's figure 3.2(a), from the end effector inwards.
class ChainBuilder {
 public:
  ChainBuilder(const LimbObservation& observation, BodyPose& joints) : observation_(observation), joints_(joints) {}

  ChainBuilder& From(Role end) {
    at_ = end;
    joints_[end] = observation_.ends[end];
    return *this;
  }
  ChainBuilder& To(Role upper, double length) {
    joints_[upper] = joints_[at_] - length * glm::normalize(observation_.directions[Index(at_)]);
    at_ = upper;
    return *this;
  }

 private:
  const LimbObservation& observation_;
  BodyPose& joints_;
  Role at_ = kHead;
};

void Shift(std::span<const Role> block, const glm::dvec3& by, BodyPose& joints) {
  for (Role role : block) joints[role] += by;
}

/// One arm or leg, from the trunk outwards.
struct Chain {
  Role root, middle, wrist, end;
};
constexpr Chain kLeftArmChain{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand};
constexpr Chain kRightArmChain{kRightShoulder, kRightElbow, kRightWrist, kRightHand};
constexpr Chain kLeftLegChain{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot};
constexpr Chain kRightLegChain{kRightHip, kRightKnee, kRightAnkle, kRightFoot};

// Fills in the missing directions and ends of one observation (`CompleteObservation`).
class Completer {
 public:
  Completer(const LimbObservation& seen, const LimbLengths& lengths, const BodyPose& like)
      : lengths_(lengths), like_(like), whole_(seen) {}

  LimbObservation Complete() {
    // Complete the directions of arms, legs and neck.
    for (const Chain& chain : {kLeftArmChain, kRightArmChain, kLeftLegChain, kRightLegChain}) {
      CompleteDirections({chain.middle, chain.wrist, chain.end});
    }
    CompleteDirections({kHead});
    // Find the midpoints of hips and shoulders from the observed end effectors. If neither effector of a pair was seen,
    // the midpoint follows from the other midpoint, from the head, or from `like`.
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
    // Extend arms and legs from these midpoints to the missing end effectors.
    PutEnds(legs, hips);
    PutEnds(arms, shoulders);
    if (Lacks(kHead)) whole_.ends[kHead] = shoulders + neck;
    return whole_;
  }

 private:
  /// A pair of chains: both arms, or both legs.
  struct LimbPair {
    Chain left, right;
    double width, upper, lower, last;
  };

  glm::dvec3 LimbOfLike(Role to) const { return UnitOr(like_[to] - like_[*ParentOf(to)], {0, -1, 0}); }
  glm::dvec3 Direction(Role to) const { return glm::normalize(whole_.directions[Index(to)]); }

  /// Completes the directions of a chain, from the trunk outwards.
  void CompleteDirections(std::initializer_list<Role> limbs) {
    glm::dmat3 turn(1);  // rotation of the last observed limb, from `like` to the observation
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

  /// Returns the vector from a chain's root to its end, computed from the lengths and directions of the limbs.
  glm::dvec3 Reach(const Chain& chain, const LimbPair& pair) const {
    return pair.upper * Direction(chain.middle) + pair.lower * Direction(chain.wrist) +
           pair.last * Direction(chain.end);
  }

  /// Returns the vector from the midpoint of both chains' roots to the right chain's root.
  glm::dvec3 HalfAcross(const LimbPair& pair) const {
    return 0.5 * pair.width * UnitOr(like_[pair.right.root] - like_[pair.left.root], {-1, 0, 0});
  }

  /// Returns the midpoint of both chains' roots, computed from the observed end effectors; nullopt if neither was
  /// observed.
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

std::span<const Role, 13> ObservedLimbs() { return kObserved; }

std::optional<BodyPose> FixLimbLengths(const LimbObservation& observation, const LimbLengths& lengths) {
  if (!IsUsable(observation) || !IsValid(lengths)) return std::nullopt;
  BodyPose joints;
  // Paper B, figure 3.2(a): build the chains of the legs, then of the arms.
  ChainBuilder chain_builder(observation, joints);
  chain_builder.From(kLeftFoot).To(kLeftAnkle, lengths.foot).To(kLeftKnee, lengths.shank).To(kLeftHip, lengths.thigh);
  chain_builder.From(kRightFoot)
      .To(kRightAnkle, lengths.foot)
      .To(kRightKnee, lengths.shank)
      .To(kRightHip, lengths.thigh);
  chain_builder.From(kLeftHand)
      .To(kLeftWrist, lengths.hand)
      .To(kLeftElbow, lengths.forearm)
      .To(kLeftShoulder, lengths.upper_arm);
  chain_builder.From(kRightHand)
      .To(kRightWrist, lengths.hand)
      .To(kRightElbow, lengths.forearm)
      .To(kRightShoulder, lengths.upper_arm);

  // Figure 3.2(b): give the hips their width by moving the right leg.
  const glm::dvec3 hip_vector = joints[kRightHip] - joints[kLeftHip];
  if (glm::length(hip_vector) < kMinGapM) return std::nullopt;
  Shift(kRightLeg, lengths.hip_width * glm::normalize(hip_vector) - hip_vector, joints);
  joints[kHipCentre] = 0.5 * (joints[kLeftHip] + joints[kRightHip]);

  // Figure 3.2(b) and (c): joining and centring both move the arms along the shoulder line, so they are one step. The
  // midpoint of the shoulders then moves until the trunk has its known length.
  const glm::dvec3 shoulder_vector = joints[kRightShoulder] - joints[kLeftShoulder];
  if (glm::length(shoulder_vector) < kMinGapM) return std::nullopt;
  const glm::dvec3 across = glm::normalize(shoulder_vector);
  const glm::dvec3 to_navel = joints[kHipCentre] - joints[kLeftShoulder];
  const glm::dvec3 foot_of_perpendicular = joints[kLeftShoulder] + glm::dot(to_navel, across) * across;
  const glm::dvec3 trunk = foot_of_perpendicular - joints[kHipCentre];
  if (glm::length(trunk) < kMinGapM) return std::nullopt;
  joints[kShoulderCentre] = joints[kHipCentre] + lengths.trunk * glm::normalize(trunk);
  const glm::dvec3 half_width = 0.5 * lengths.shoulder_width * across;
  Shift(kLeftArm, joints[kShoulderCentre] - half_width - joints[kLeftShoulder], joints);
  Shift(kRightArm, joints[kShoulderCentre] + half_width - joints[kRightShoulder], joints);

  // Compute the head and the spine from the trunk.
  joints[kHead] = joints[kShoulderCentre] + lengths.neck * glm::normalize(observation.directions[Index(kHead)]);
  joints[kSpine] = glm::mix(joints[kHipCentre], joints[kShoulderCentre], kSpineShare);
  return joints;
}

LimbLengths MeasureLimbLengths(std::span<const BodyPose> poses) {
  assert(!poses.empty());
  LimbLengths sum{0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  for (const BodyPose& pose : poses) {
    const auto between = [&](Role a, Role b) { return glm::distance(pose[a], pose[b]); };
    const auto of_both = [&](Role a, Role b) { return 0.5 * (between(a, b) + between(Mirrored(a), Mirrored(b))); };
    // Add the lengths of this frame to the sums.
    const glm::dvec3 mid_hips = 0.5 * (pose[kLeftHip] + pose[kRightHip]);
    const glm::dvec3 mid_shoulders = 0.5 * (pose[kLeftShoulder] + pose[kRightShoulder]);
    sum.foot += of_both(kLeftAnkle, kLeftFoot);
    sum.shank += of_both(kLeftKnee, kLeftAnkle);
    sum.thigh += of_both(kLeftHip, kLeftKnee);
    sum.hip_width += between(kLeftHip, kRightHip);
    sum.trunk += glm::distance(mid_hips, mid_shoulders);
    sum.neck += glm::distance(mid_shoulders, pose[kHead]);
    sum.shoulder_width += between(kLeftShoulder, kRightShoulder);
    sum.upper_arm += of_both(kLeftShoulder, kLeftElbow);
    sum.forearm += of_both(kLeftElbow, kLeftWrist);
    sum.hand += of_both(kLeftWrist, kLeftHand);
  }
  const double n = static_cast<double>(poses.size());
  return {sum.foot / n, sum.shank / n,          sum.thigh / n,     sum.hip_width / n, sum.trunk / n,
          sum.neck / n, sum.shoulder_width / n, sum.upper_arm / n, sum.forearm / n,   sum.hand / n};
}

std::optional<LimbObservation> CompleteObservation(const LimbObservation& seen, const LimbLengths& lengths,
                                                   const BodyPose& like, bool is_placed) {
  const auto lacks = [](const std::array<bool, kRoleCount>& roles) {
    return std::ranges::find(roles, true) != roles.end();
  };
  if (!lacks(seen.lacks_end) && !lacks(seen.lacks_direction)) return seen;
  const bool is_seen = std::ranges::any_of(kEnds, [&](Role end) { return !seen.lacks_end[Index(end)]; });
  if (!is_seen && !is_placed) return std::nullopt;
  return Completer(seen, lengths, like).Complete();
}

}  // namespace etude
