#include "engine/transitions/library/body_proportions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/fuzzy/features.h"
#include "engine/motion/rest_body.h"

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

/// The lengths of thigh and shin of both legs.
using LegLengths = std::array<double, 4>;

LegLengths LegsOf(const BodyPose& pose) {
  const auto length = [&](Role from, Role to) { return glm::distance(pose[from], pose[to]); };
  return {length(kLeftHip, kLeftKnee), length(kLeftKnee, kLeftAnkle), length(kRightHip, kRightKnee),
          length(kRightKnee, kRightAnkle)};
}

bool AreEqual(const LegLengths& a, const LegLengths& b) {
  constexpr double kSame = 1e-4;
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= kSame; });
}

double LowerFoot(const BodyPose& pose) {
  return std::min({pose[kLeftFoot].y, pose[kRightFoot].y, pose[kLeftAnkle].y, pose[kRightAnkle].y});
}

std::vector<double> FootHeights(const BodyMotion& motion) {
  std::vector<double> heights;
  std::ranges::transform(motion.poses, std::back_inserter(heights), LowerFoot);
  return heights;
}

/// Returns the floor's height: the 5th percentile of `heights`, because a single bad frame can change the minimum.
/// There must be at least one height.
double FloorHeight(std::vector<double> heights) {
  const auto fifth_percentile = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
  std::nth_element(heights.begin(), fifth_percentile, heights.end());
  return *fifth_percentile;
}

/// Gives a moving body the limb lengths of `proportions`; does not correct the body's height above the floor.
void Rescale(const BodyProportions& proportions, BodyMotion& motion) {
  if (motion.poses.empty()) return;
  const double own_height = StandingHipHeight(motion.poses.front());
  const double scale = own_height > 0 ? proportions.standing_hip_height / own_height : 1.0;
  for (BodyPose& pose : motion.poses) pose = Rebuild(proportions, pose, scale);
}

/// Returns groups of clip indices: one group for each person who performs clips.
std::vector<std::vector<std::size_t>> ByPerson(std::span<const BodyMotion> motions) {
  std::vector<std::vector<std::size_t>> people;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions[i].poses.empty()) continue;
    const LegLengths legs = LegsOf(motions[i].poses.front());
    const auto is_theirs = [&](const std::vector<std::size_t>& clips) {
      return AreEqual(legs, LegsOf(motions[clips.front()].poses.front()));
    };
    const auto known = std::ranges::find_if(people, is_theirs);
    known != people.end() ? known->push_back(i) : people.push_back({i});
  }
  return people;
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

BodyProportions MedianProportions(std::span<const BodyPose> poses) {
  const auto median = [&](const auto& value) {
    std::vector<double> values;
    for (const BodyPose& pose : poses) values.push_back(value(pose));
    return Median(std::move(values));
  };
  BodyProportions proportions{.limb_lengths = {}, .standing_hip_height = median(StandingHipHeight)};
  for (const Bone& bone : AllBones()) {
    proportions.limb_lengths[Index(bone.child)] = median([&](const BodyPose& pose) { return BoneLength(pose, bone); });
  }
  return proportions;
}

BodyPose StandingPose(const BodyProportions& proportions) {
  BodyPose pose;
  pose[kHipCentre] = {0, proportions.standing_hip_height, 0};
  for (const Bone& bone : AllBones()) {
    const double length = proportions.limb_lengths[Index(bone.child)];
    glm::dvec3 limb = length * DirectionAtRest(bone.child);
    // Point the feet down to the floor.
    if (bone.child == kLeftFoot || bone.child == kRightFoot) {
      const double drop = std::clamp(pose[bone.parent].y, 0.0, length);
      limb = {0, -drop, std::sqrt(length * length - drop * drop)};
    }
    pose[bone.child] = pose[bone.parent] + limb;
  }
  return pose;
}

void PerformBy(const BodyProportions& proportions, std::span<BodyMotion> motions) {
  const std::vector<std::vector<std::size_t>> people = ByPerson(motions);
  for (BodyMotion& motion : motions) Rescale(proportions, motion);
  // Shift all clips of one person together, so that the person stands on the floor.
  for (const std::vector<std::size_t>& clips : people) {
    std::vector<double> heights;
    for (std::size_t clip : clips) std::ranges::copy(FootHeights(motions[clip]), std::back_inserter(heights));
    const double common = FloorHeight(std::move(heights));
    for (std::size_t clip : clips) {
      const double floor = std::min(common, FloorHeight(FootHeights(motions[clip])));
      for (BodyPose& pose : motions[clip].poses) {
        for (glm::dvec3& joint : pose.joints) joint.y -= floor;
      }
    }
  }
}

std::vector<BodyMotion> PerformedBy(const BodyProportions& proportions, std::span<const BodyMotion> motions) {
  std::vector<BodyMotion> performed(motions.begin(), motions.end());
  PerformBy(proportions, performed);
  return performed;
}

}  // namespace etude
