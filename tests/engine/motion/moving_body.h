#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <tuple>
#include <utility>

#include "engine/base/angles.h"
#include "engine/motion/motion_faults.h"
#include "tests/engine/motion/standing_body.h"

namespace etude {

inline constexpr double kGravity = 9.81, kFlight_s = 0.4, kStance_s = 0.5;

/// Returns the standing body with its hips at a height, its feet lifted, knees bent accordingly, and arms at an angle.
inline BodyPose Posed(double hips, double lift, double sway, double arms) {
  constexpr double kBone = 0.4;
  using enum Role;
  BodyPose pose = Standing();
  for (const Role role : AllRoles()) pose[role] += glm::dvec3(sway, hips - 0.9, 0);
  for (const auto& [hip, knee, ankle, foot] : {std::tuple{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
                                               std::tuple{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}) {
    for (const Role joint : {ankle, foot}) pose[joint] = Standing()[joint] + glm::dvec3(0, lift, 0);
    const glm::dvec3 leg = pose[ankle] - pose[hip];
    const double forward = std::sqrt(std::max(0.0, kBone * kBone - glm::dot(leg, leg) / 4));
    const glm::dvec3 front = glm::normalize(glm::cross(leg, glm::dvec3(1, 0, 0)));
    pose[knee] = pose[hip] + 0.5 * leg + forward * front;
  }
  for (const Role joint : {kLeftElbow, kLeftWrist, kLeftHand}) {
    const glm::dquat turn = glm::angleAxis(arms, glm::dvec3(0, 0, 1));
    pose[joint] = pose[kLeftShoulder] + turn * (pose[joint] - pose[kLeftShoulder]);
    const glm::dvec3 right = pose[Mirrored(joint)] - pose[kRightShoulder];
    pose[Mirrored(joint)] = pose[kRightShoulder] + glm::inverse(turn) * right;
  }
  return pose;
}

/// Returns a person who hops on the spot: flights of 0.4 s, stances of 0.5 s with bending knees.
inline BodyMotion Hopping(double rate_hz, double seconds = 6) {
  constexpr double kStraight = 0.89, kCycle = kFlight_s + kStance_s, kTakeOff_m_s = kGravity * kFlight_s / 2;
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  for (int f = 0; f < seconds * rate_hz; ++f) {
    const double t = f / rate_hz, phase = std::fmod(t + 0.1, kCycle), flown = phase - kStance_s;
    const double lift = flown > 0 ? kTakeOff_m_s * flown - kGravity * flown * flown / 2 : 0;
    const double dip = flown > 0 ? 0 : kTakeOff_m_s * kStance_s / kPi * std::sin(kPi * phase / kStance_s);
    motion.poses.push_back(Posed(kStraight + lift - dip, lift, 0.02 * std::sin(2 * t), 0.5 * std::sin(3 * t)));
  }
  return motion;
}

inline BodyMotion Swaying(double rate_hz, double seconds = 6) {
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  for (int f = 0; f < seconds * rate_hz; ++f) {
    const double t = f / rate_hz;
    motion.poses.push_back(Posed(0.86 + 0.02 * std::sin(3 * t), 0, 0.03 * std::sin(2 * t), 0.6 * std::sin(4 * t)));
  }
  return motion;
}

/// Changes the poses of the frames from `from` to `to`, seconds, by `change(pose, seconds since from)`.
inline BodyMotion WithChange(BodyMotion motion, double from, double to,
                             const std::function<void(BodyPose& pose, double seconds)>& change) {
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const double t = static_cast<double>(f) / motion.rate_hz;
    if (t >= from - 1e-9 && t < to - 1e-9) change(motion.poses[f], t - from);
  }
  return motion;
}

/// Expects exactly one fault, and returns it.
inline MotionFault OneFault(const BodyMotion& motion, FaultKind kind) {
  const auto found = FindMotionFaults(motion).faults;
  EXPECT_EQ(found.size(), 1u) << FaultName(kind) << ": " << ::testing::PrintToString(FaultSentences(found));
  if (found.empty()) return {};
  EXPECT_EQ(FaultName(found.front().kind), FaultName(kind)) << found.front().text;
  return found.front();
}

inline void ExpectTime(const MotionFault& fault, double from, double to, double tolerance = 0.05) {
  EXPECT_NEAR(fault.from_s, from, tolerance) << fault.text;
  EXPECT_NEAR(fault.to_s, to, tolerance) << fault.text;
}

}  // namespace etude
