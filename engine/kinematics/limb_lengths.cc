#include "engine/kinematics/limb_lengths.h"

#include <cassert>
#include <cmath>

#include "engine/kinematics/body_tree.h"

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

// Hips, shoulders or trunk ends nearer than this give no direction.
constexpr double kSmallestGap = 1e-6;  // metres

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

// Fixes one block of figure 3.2(a), from its end up.
class Climber {
 public:
  Climber(const LimbObservation& observation, BodyPose& joints) : observation_(observation), joints_(joints) {}

  Climber& From(Role end) {
    at_ = end;
    joints_[end] = observation_.ends[end];
    return *this;
  }
  Climber& To(Role upper, double length) {
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

}  // namespace

std::span<const Role, 13> ObservedLimbs() { return kObserved; }

std::optional<BodyPose> FixLimbLengths(const LimbObservation& observation, const LimbLengths& lengths) {
  if (!IsUsable(observation) || !IsValid(lengths)) return std::nullopt;
  BodyPose joints;
  Climber climber(observation, joints);
  climber.From(kLeftFoot).To(kLeftAnkle, lengths.foot).To(kLeftKnee, lengths.shank).To(kLeftHip, lengths.thigh);
  climber.From(kRightFoot).To(kRightAnkle, lengths.foot).To(kRightKnee, lengths.shank).To(kRightHip, lengths.thigh);
  climber.From(kLeftHand)
      .To(kLeftWrist, lengths.hand)
      .To(kLeftElbow, lengths.forearm)
      .To(kLeftShoulder, lengths.upper_arm);
  climber.From(kRightHand)
      .To(kRightWrist, lengths.hand)
      .To(kRightElbow, lengths.forearm)
      .To(kRightShoulder, lengths.upper_arm);

  // Figure 3.2(b), the legs.
  const glm::dvec3 hip_vector = joints[kRightHip] - joints[kLeftHip];
  if (glm::length(hip_vector) < kSmallestGap) return std::nullopt;
  Shift(kRightLeg, lengths.hip_width * glm::normalize(hip_vector) - hip_vector, joints);
  joints[kHipCentre] = 0.5 * (joints[kLeftHip] + joints[kRightHip]);

  // Figure 3.2(b) and (c), the arms: joining and centring both move along the shoulder line, so that they are one step.
  const glm::dvec3 shoulder_vector = joints[kRightShoulder] - joints[kLeftShoulder];
  if (glm::length(shoulder_vector) < kSmallestGap) return std::nullopt;
  const glm::dvec3 across = glm::normalize(shoulder_vector);
  const glm::dvec3 to_navel = joints[kHipCentre] - joints[kLeftShoulder];
  const glm::dvec3 foot_of_perpendicular = joints[kLeftShoulder] + glm::dot(to_navel, across) * across;
  const glm::dvec3 trunk = foot_of_perpendicular - joints[kHipCentre];
  if (glm::length(trunk) < kSmallestGap) return std::nullopt;
  joints[kShoulderCentre] = joints[kHipCentre] + lengths.trunk * glm::normalize(trunk);
  const glm::dvec3 half_width = 0.5 * lengths.shoulder_width * across;
  Shift(kLeftArm, joints[kShoulderCentre] - half_width - joints[kLeftShoulder], joints);
  Shift(kRightArm, joints[kShoulderCentre] + half_width - joints[kRightShoulder], joints);

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

}  // namespace etude
