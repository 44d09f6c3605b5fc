#include "reports/films/followed_way.h"

#include <algorithm>

namespace etude {
namespace {

constexpr double kFreeRoom = 0.45;

}  // namespace

std::vector<glm::dvec3> FollowedWay(const BodyMotion& motion, int smoothing) {
  const int count = static_cast<int>(motion.poses.size());
  glm::dvec3 low = motion.poses.front()[Role::kHipCentre], high = low;
  for (const BodyPose& pose : motion.poses) {
    low = glm::min(low, pose[Role::kHipCentre]);
    high = glm::max(high, pose[Role::kHipCentre]);
  }
  const glm::dvec3 half = (high - low) / 2.0;
  if (half.x < kFreeRoom && half.z < kFreeRoom) return std::vector(motion.poses.size(), low + half);
  std::vector<glm::dvec3> way;
  for (int frame = 0; frame < count; ++frame) {
    glm::dvec3 sum{0};
    for (int k = -smoothing; k <= smoothing; ++k) {
      sum += motion.poses[static_cast<std::size_t>(std::clamp(frame + k, 0, count - 1))][Role::kHipCentre];
    }
    way.push_back(sum / (2.0 * smoothing + 1));
  }
  return way;
}

}  // namespace etude
