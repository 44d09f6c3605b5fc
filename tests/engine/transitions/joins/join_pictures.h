#pragma once

#include <algorithm>
#include <vector>

#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/expect_pose.h"

namespace etude {

/// Returns the largest second difference of any joint at a frame, metres.
inline double JumpAt(const BodyMotion& motion, int frame) {
  double worst = 0;
  for (Role role : AllRoles()) {
    worst = std::max(worst, glm::length(motion.poses[frame + 1][role] - 2.0 * motion.poses[frame][role] +
                                        motion.poses[frame - 1][role]));
  }
  return worst;
}

/// Returns the segments: clip 0 up to frame `left`, then clip 1 after frame `entered`.
inline std::vector<Segment> Segments(int left, int entered, const BodyMotion& next) {
  return {{.clip = 0, .first = 0, .last = left, .own = {}},
          {.clip = 1, .first = entered, .last = static_cast<int>(next.poses.size()) - 1, .own = {}}};
}

}  // namespace etude
