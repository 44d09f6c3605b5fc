#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/motion/body.h"
#include "sim/choreography/canonical_body.h"
#include "tests/support/gaps.h"

namespace etude {

/// A toe slower than this stands still.
constexpr double kStillMmps = 5;

/// Returns the highest speed (mm/s) of a toe along the floor while it is down, and the number of such frames.
inline std::pair<double, int> FastestSlide(const BodyMotion& motion, Role toe) {
  constexpr double kDown = 0.0005;
  double fastest = 0;
  int down = 0;
  for (std::size_t i = 1; i < motion.poses.size(); ++i) {
    const glm::dvec3 &before = motion.poses[i - 1][toe], &now = motion.poses[i][toe];
    if (std::max(before.y, now.y) > CanonicalBody::kToeHeight + kDown) continue;
    ++down;
    fastest = std::max(fastest, 1000 * motion.rate_hz * std::hypot(now.x - before.x, now.z - before.z));
  }
  return {fastest, down};
}

}  // namespace etude
