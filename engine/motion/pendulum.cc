#include "engine/motion/pendulum.h"

#include <algorithm>
#include <cmath>

namespace etude {

glm::dvec3 AccelerationAt(std::span<const glm::dvec3> centres, int frame, double rate_hz) {
  constexpr double kReach_s = 0.1;
  const int reach = std::max(static_cast<int>(std::lround(kReach_s * rate_hz)), 1);
  const int last = static_cast<int>(centres.size()) - 1;
  if (last < 2 * reach) return glm::dvec3(0);
  const int middle = std::clamp(frame, reach, last - reach);
  const double per_s = rate_hz / reach;
  return (centres[middle - reach] - 2.0 * centres[middle] + centres[middle + reach]) * (per_s * per_s);
}

glm::dvec2 ZeroMomentPoint(std::span<const glm::dvec3> centres, int frame, double rate_hz, double ground) {
  constexpr double kGravity = 9.81;
  const glm::dvec3 &centre = centres[frame], acceleration = AccelerationAt(centres, frame, rate_hz);
  const double per_mps2 = (centre.y - ground) / kGravity;
  return {centre.x - per_mps2 * acceleration.x, centre.z - per_mps2 * acceleration.z};
}

std::optional<double> ZeroMomentOffset(std::span<const glm::dvec3> centres, int frame, double rate_hz,
                                       const BodyPose& pose, const JointSet& bears) {
  if (bears.none()) return std::nullopt;
  double ground = centres[frame].y;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    if (bears[j]) ground = std::min(ground, pose.joints[j].y);
  }
  return OffsetFromJoints(ZeroMomentPoint(centres, frame, rate_hz, ground), pose, bears);
}

}  // namespace etude
