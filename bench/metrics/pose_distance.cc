#include "bench/metrics/pose_distance.h"

#include <cmath>

namespace etude {

double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (Role role : AllRoles()) sum += glm::distance(a[role], b[role]);
  return 100 * sum / static_cast<double>(kRoleCount);
}

double RootMeanSquareJointDistanceCm(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (Role role : AllRoles()) {
    const glm::dvec3 gap = a[role] - b[role];
    sum += glm::dot(gap, gap);
  }
  return 100 * std::sqrt(sum / static_cast<double>(kRoleCount));
}

}  // namespace etude
