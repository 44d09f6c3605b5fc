#include "engine/retargeting/check_sides.h"

#include <algorithm>

namespace etude {
namespace {

using enum Role;

glm::dvec3 Direction(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 Across(const BodyPose& pose, Role left, Role right) { return Direction(pose[left] - pose[right]); }

/// Where chest and belly look.
glm::dvec3 Forward(const BodyPose& pose) {
  return Direction(glm::cross(Across(pose, kLeftHip, kRightHip), Direction(pose[kShoulderCentre] - pose[kHipCentre])));
}

glm::dvec3 Toe(const BodyPose& pose, Role ankle, Role toe) { return Direction(pose[toe] - pose[ankle]); }

/// How far the knee stands out from the straight line, in lengths of the leg.
glm::dvec3 Knee(const BodyPose& pose, Role hip, Role knee, Role ankle) {
  const double leg = glm::distance(pose[hip], pose[knee]) + glm::distance(pose[knee], pose[ankle]);
  return leg > 0 ? (pose[knee] - 0.5 * (pose[hip] + pose[ankle])) / leg : glm::dvec3(0);
}

}  // namespace

Result<void> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file) {
  double arms = 0;
  double toes = 0;
  double knees = 0;
  for (const BodyPose& pose : poses) {
    const glm::dvec3 forward = Forward(pose);
    arms += glm::dot(Across(pose, kLeftShoulder, kRightShoulder), Across(pose, kLeftHip, kRightHip));
    toes += glm::dot(forward, Toe(pose, kLeftAnkle, kLeftFoot) + Toe(pose, kRightAnkle, kRightFoot));
    knees +=
        glm::dot(forward, Knee(pose, kLeftHip, kLeftKnee, kLeftAnkle) + Knee(pose, kRightHip, kRightKnee, kRightAnkle));
  }
  if (arms < 0) {
    return Fail({file}, "the left arm is on the side of the right leg; left and right are mixed up");
  }
  // Per foot and frame. Feet that hang down from a lying body point backwards a little.
  constexpr double kBackwards = 0.35;
  const auto count = static_cast<double>(2 * poses.size());
  const bool has_feet = std::ranges::find(map.composed, kLeftFoot) == map.composed.end();
  if (has_feet && toes < -kBackwards * count) {
    return Fail({file}, "the feet point backwards: left and right are swapped, or the axes are left-handed");
  }
  constexpr double kBent = 0.01;
  if (!has_feet && knees < -kBent * count) {
    return Fail({file}, "the knees bend backwards: left and right are swapped, or the axes are left-handed");
  }
  return {};
}

}  // namespace etude
