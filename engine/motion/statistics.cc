#include "engine/motion/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace etude {
namespace {

using enum Role;

/// The value below which `share` of all values lie, straight between neighbours.
double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

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

double Stature(const BodyPose& pose) {
  const auto way = [&](std::initializer_list<Role> roles) {
    double length = 0;
    for (auto role = roles.begin(); role + 1 != roles.end(); ++role) {
      length += glm::distance(pose[*role], pose[*(role + 1)]);
    }
    return length;
  };
  // Below the ankles and above the head's joint: 4 to 12 % of the stature in the files at hand.
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
  found.stature_m = Quantile(std::move(statures), 0.5);
  MeasureSpeeds(motion, found);
  found.foot_slide_m_s = FootSlide(motion);
  found.lowest_foot_m = LowestPoint(motion, {kLeftFoot, kLeftAnkle, kRightFoot, kRightAnkle});
  return found;
}

double FootSlide(const BodyMotion& motion) {
  constexpr double kLifted = 0.025;  // metres: a foot this high no longer stands
  if (motion.poses.size() < 2) return 0;
  double sum = 0;
  for (const Role foot : {kLeftFoot, kRightFoot}) {
    const double floor = LowestPoint(motion, {foot});
    for (std::size_t f = 0; f + 1 < motion.poses.size(); ++f) {
      const glm::dvec3& here = motion.poses[f][foot];
      const double standing = std::clamp(2.0 - std::exp2((here.y - floor) / kLifted), 0.0, 1.0);
      sum += standing * Horizontal(motion.poses[f + 1][foot] - here) * motion.rate_hz;
    }
  }
  constexpr double kFeet = 2;
  return sum / (kFeet * static_cast<double>(motion.poses.size() - 1));
}

}  // namespace etude
