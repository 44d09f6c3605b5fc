#include "engine/transitions/library/body_proportions.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "engine/fuzzy/features.h"

namespace etude {
namespace {

using enum Role;

BodyPose Rebuild(const BodyProportions& proportions, const BodyPose& source, double scale) {
  BodyPose pose;
  pose[kHipCentre] = scale * source[kHipCentre];
  std::array<glm::dvec3, kRoleCount> directions{};
  directions[Index(kHipCentre)] = {0, 1, 0};
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 limb = source[bone.child] - source[bone.parent];
    const double length = glm::length(limb);
    constexpr double kNoLimb = 1e-6;
    glm::dvec3& direction = directions[Index(bone.child)];
    direction = length < kNoLimb ? directions[Index(bone.parent)] : limb / length;
    pose[bone.child] = pose[bone.parent] + proportions.limb_lengths[Index(bone.child)] * direction;
  }
  return pose;
}

/// Where the floor is: not the lowest frame of all, which one bad frame would decide.
double FloorHeight(const BodyMotion& motion) {
  std::vector<double> heights;
  heights.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) {
    heights.push_back(std::min({pose[kLeftFoot].y, pose[kRightFoot].y, pose[kLeftAnkle].y, pose[kRightAnkle].y}));
  }
  const auto fifth_percent = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
  std::nth_element(heights.begin(), fifth_percent, heights.end());
  return *fifth_percent;
}

}  // namespace

BodyProportions MakeBodyProportions(const BodyPose& pose, double standing_hip_height) {
  const double own_height = StandingHipHeight(pose);
  assert(own_height > 0);
  BodyProportions proportions{.limb_lengths = {}, .standing_hip_height = standing_hip_height};
  for (const Bone& bone : AllBones()) {
    proportions.limb_lengths[Index(bone.child)] = BoneLength(pose, bone) * standing_hip_height / own_height;
  }
  return proportions;
}

BodyMotion PerformedBy(const BodyProportions& proportions, const BodyMotion& motion) {
  BodyMotion performed{.rate_hz = motion.rate_hz, .poses = {}};
  if (motion.poses.empty()) return performed;
  const double own_height = StandingHipHeight(motion.poses.front());
  const double scale = own_height > 0 ? proportions.standing_hip_height / own_height : 1.0;
  performed.poses.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) performed.poses.push_back(Rebuild(proportions, pose, scale));
  const double floor = FloorHeight(performed);
  for (BodyPose& pose : performed.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y -= floor;
  }
  return performed;
}

}  // namespace etude
