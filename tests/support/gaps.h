#pragma once

#include <algorithm>

#include "engine/motion/body.h"

namespace etude {

/// Returns the largest distance of a joint between two poses, metres.
inline double WorstJointDistance(const BodyPose& a, const BodyPose& b) {
  double worst = 0;
  for (const Role role : AllRoles()) worst = std::max(worst, glm::distance(a[role], b[role]));
  return worst;
}

/// Returns the largest WorstJointDistance over all frames; a kilometre for motions of different lengths.
inline double WorstJointDistance(const BodyMotion& a, const BodyMotion& b) {
  double worst = a.poses.size() == b.poses.size() ? 0 : 1000;
  for (std::size_t f = 0; f < std::min(a.poses.size(), b.poses.size()); ++f) {
    worst = std::max(worst, WorstJointDistance(a.poses[f], b.poses[f]));
  }
  return worst;
}

}  // namespace etude
