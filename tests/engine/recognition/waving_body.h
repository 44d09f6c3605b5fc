#pragma once

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <vector>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// Returns a standing body with straight arms raised sideways; `left` and `right` are radians from hanging. `size`
/// scales the body, `move` moves it.
inline BodyPose ArmsRaised(double left, double right, double size = 1, const FloorMove& move = {}) {
  using enum Role;
  BodyPose pose;
  const auto put = [&](Role role, double x, double y, double z = 0) { pose[role] = size * glm::dvec3(x, y, z); };
  put(kHipCentre, 0, 0.9);
  put(kSpine, 0, 1.0);
  put(kShoulderCentre, 0, 1.4);
  put(kHead, 0, 1.65);
  for (int side : {1, -1}) {
    const bool is_left = side > 0;
    const double angle = is_left ? left : right, x = 0.18 * side, y = 1.38;
    const auto along = [&](Role role, double length) {
      put(role, x + side * length * std::sin(angle), y - length * std::cos(angle));
    };
    put(is_left ? kLeftShoulder : kRightShoulder, x, y);
    along(is_left ? kLeftElbow : kRightElbow, 0.29);
    along(is_left ? kLeftWrist : kRightWrist, 0.54);
    along(is_left ? kLeftHand : kRightHand, 0.7);
    put(is_left ? kLeftHip : kRightHip, 0.09 * side, 0.88);
    put(is_left ? kLeftKnee : kRightKnee, 0.09 * side, 0.47);
    put(is_left ? kLeftAnkle : kRightAnkle, 0.09 * side, 0.06);
    put(is_left ? kLeftFoot : kRightFoot, 0.09 * side, 0, 0.15);
  }
  return move.Apply(pose);
}

/// Returns a motion of `seconds` at 30 Hz in which the arms swing once up to `left` and `right`, and back.
inline BodyMotion Swing(double left, double right, double seconds, double size = 1, const FloorMove& move = {}) {
  BodyMotion motion;
  const int frames = static_cast<int>(seconds * motion.rate_hz);
  for (int i = 0; i < frames; ++i) {
    const double raised = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / frames);
    motion.poses.push_back(ArmsRaised(left * raised, right * raised, size, move));
  }
  return motion;
}

inline BodyMotion Rest(double seconds, double size = 1, const FloorMove& move = {}) {
  return Swing(0, 0, seconds, size, move);
}

inline SkeletonStream Then(const std::vector<BodyMotion>& motions) {
  BodyMotion all;
  for (const BodyMotion& motion : motions) all.poses.insert(all.poses.end(), motion.poses.begin(), motion.poses.end());
  return StreamOf(all);
}

}  // namespace etude
