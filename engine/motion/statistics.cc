#include "engine/motion/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/support.h"

namespace etude {
namespace {

using enum Role;

double Horizontal(const glm::dvec3& step) { return std::hypot(step.x, step.z); }

double LowestPoint(const BodyMotion& motion, std::initializer_list<Role> joints) {
  double lowest = motion.poses.front()[*joints.begin()].y;
  for (const BodyPose& pose : motion.poses) {
    for (const Role joint : joints) lowest = std::min(lowest, pose[joint].y);
  }
  return lowest;
}

void MeasureSpeeds(const BodyMotion& motion, MotionStatistics& found) {
  std::vector<double> fastest_of_frame;
  for (std::size_t f = 0; f + 1 < motion.poses.size(); ++f) {
    const BodyPose& here = motion.poses[f];
    const BodyPose& next = motion.poses[f + 1];
    double fastest = 0;
    for (const Role role : AllRoles()) {
      const double speed = glm::distance(here[role], next[role]) * motion.rate_hz;
      fastest = std::max(fastest, speed);
      if (speed > found.speed_peak_m_s) {
        found.speed_peak_m_s = speed;
        found.fastest = role;
      }
    }
    fastest_of_frame.push_back(fastest);
    found.travelled_m += Horizontal(next[kHipCentre] - here[kHipCentre]);
  }
  if (fastest_of_frame.empty()) return;
  found.speed_median_m_s = Quantile(fastest_of_frame, 0.5);
  found.speed_p95_m_s = Quantile(fastest_of_frame, 0.95);
}

}  // namespace

double LowestHeight(const BodyPose& pose) {
  double lowest = pose[kHipCentre].y;
  for (const Role role : AllRoles()) {
    if (role != kLeftHand && role != kRightHand) lowest = std::min(lowest, pose[role].y);
  }
  return lowest;
}

double Stature(const BodyPose& pose) {
  const auto way = [&](std::initializer_list<Role> roles) {
    double length = 0;
    for (auto role = roles.begin(); role + 1 != roles.end(); ++role) {
      length += glm::distance(pose[*role], pose[*(role + 1)]);
    }
    return length;
  };
  // In our files, the parts below the ankles and above the head joint are 4 to 12 % of the stature.
  constexpr double kMeasuredShare = 0.92;
  const double left_leg = way({kLeftAnkle, kLeftKnee, kLeftHip});
  const double right_leg = way({kRightAnkle, kRightKnee, kRightHip});
  const double trunk_and_head = way({kHipCentre, kSpine, kShoulderCentre, kHead});
  return (0.5 * (left_leg + right_leg) + trunk_and_head) / kMeasuredShare;
}

MotionStatistics ComputeStatistics(const BodyMotion& motion) {
  assert(!motion.poses.empty());
  MotionStatistics found;
  std::vector<double> statures;
  for (const BodyPose& pose : motion.poses) statures.push_back(Stature(pose));
  found.stature_m = Quantile(statures, 0.5);
  MeasureSpeeds(motion, found);
  found.foot_slide = MeasureFootSlide(motion);
  found.lowest_foot_m = LowestPoint(motion, {kLeftFoot, kLeftAnkle, kRightFoot, kRightAnkle});
  return found;
}

FootSlide MeasureFootSlide(const BodyMotion& motion) {
  constexpr double kFloorQuantile = 0.25;
  constexpr Role kFeet[2][2] = {{kLeftAnkle, kLeftFoot}, {kRightAnkle, kRightFoot}};
  const std::vector<BodyPose> velocities = JointVelocities(motion.poses, motion.rate_hz);
  const std::vector<Bearing> bearing = FindBearing(motion.poses, motion.rate_hz, kFootRules);
  // Estimate the height of the floor.
  std::vector<double> lowest;
  for (const BodyPose& pose : motion.poses) {
    lowest.push_back(std::ranges::min(pose.joints, {}, [](const glm::dvec3& joint) { return joint.y; }).y);
  }
  FootSlide slide;
  if (motion.poses.empty()) return slide;
  const double reach = Quantile(lowest, kFloorQuantile) + kFootRules.height;
  // Sum the speed of each foot over the frames in which it stands.
  std::array<double, 2> sum{}, stances{};
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const bool is_carried = bearing[f].rests.none() && lowest[f] <= reach;
    for (std::size_t side = 0; side < 2; ++side) {
      std::optional<double> slowest;
      for (const Role joint : kFeet[side]) {
        const bool is_low = motion.poses[f][joint].y <= lowest[f] + kFootRules.lowest;
        if (!bearing[f].rests[Index(joint)] && !(is_carried && is_low)) continue;
        const double speed = Horizontal(velocities[f][joint]);
        slowest = std::min(slowest.value_or(speed), speed);
      }
      if (!slowest) continue;
      sum[side] += *slowest;
      ++stances[side];
    }
  }
  // Average the speeds over the frames: for each foot, then for both feet together.
  for (std::size_t side = 0; side < 2; ++side) {
    if (stances[side] > 0) slide.of_foot[side] = sum[side] / stances[side];
    slide.stance_share[side] = stances[side] / static_cast<double>(motion.poses.size());
  }
  if (stances[0] + stances[1] > 0) slide.mean = (sum[0] + sum[1]) / (stances[0] + stances[1]);
  return slide;
}

}  // namespace etude
