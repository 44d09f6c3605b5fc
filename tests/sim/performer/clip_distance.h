#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// One performance, normalised: hips at the origin, trunk 50 cm long, 15 Hz.
using NormalisedClip = std::vector<BodyPose>;

inline NormalisedClip Normalised(const std::vector<BodyPose>& poses) {
  constexpr double kTrunk = 0.5;
  NormalisedClip clip;
  for (std::size_t i = 0; i < poses.size(); i += 2) {
    const BodyPose& pose = poses[i];
    const double trunk = glm::distance(pose[Role::kHipCentre], pose[Role::kSpine]) +
                         glm::distance(pose[Role::kSpine], pose[Role::kShoulderCentre]);
    BodyPose& placed = clip.emplace_back();
    for (Role role : AllRoles()) placed[role] = (pose[role] - pose[Role::kHipCentre]) * (kTrunk / trunk);
  }
  return clip;
}

/// Returns the root mean square distance over the joints, metres.
inline double RmsGap(const BodyPose& a, const BodyPose& b) {
  double square = 0;
  for (Role role : AllRoles()) {
    const glm::dvec3 gap = a[role] - b[role];
    square += glm::dot(gap, gap);
  }
  return std::sqrt(square / kRoleCount);
}

/// Returns the dynamic time warping distance: the mean gap along the path with the smallest sum of gaps, centimetres.
inline double WarpedDistanceCm(const NormalisedClip& a, const NormalisedClip& b) {
  struct Path {
    double sum = std::numeric_limits<double>::infinity();
    int steps = 0;
  };
  std::vector<Path> before(b.size() + 1), now(b.size() + 1);
  before[0] = {0, 0};
  for (const BodyPose& pose : a) {
    now[0] = {};
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const Path best =
          std::min({before[j - 1], before[j], now[j - 1]}, [](const Path& x, const Path& y) { return x.sum < y.sum; });
      now[j] = {best.sum + RmsGap(pose, b[j - 1]), best.steps + 1};
    }
    std::swap(before, now);
  }
  return 100 * before.back().sum / before.back().steps;
}

}  // namespace etude
