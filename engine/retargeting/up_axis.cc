#include "engine/retargeting/up_axis.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/statistics.h"

namespace etude {
namespace {

using enum Role;

/// The least length of a mean or resting body axis along an axis of the file that means standing.
constexpr double kStanding = 0.9;
/// Mostly upright: people bend, sit and fall.
constexpr double kMostlyStanding = 0.5;

/// Says whether the hips move about on a floor of X and Y, by half a body's length.
bool TravelsOverXY(std::span<const BodyPose> poses) {
  glm::dvec3 low = poses.front()[kHipCentre];
  glm::dvec3 high = low;
  for (const BodyPose& pose : poses) {
    low = glm::min(low, pose[kHipCentre]);
    high = glm::max(high, pose[kHipCentre]);
  }
  return std::max(high.x - low.x, high.y - low.y) > 0.5 * Stature(poses.front());
}

}  // namespace

glm::dvec3 Upright(const glm::dvec3& point, UpAxis up) {
  return up == UpAxis::kY ? point : glm::dvec3(point.x, point.z, -point.y);
}

BodyPose Upright(BodyPose pose, UpAxis up) {
  for (glm::dvec3& joint : pose.joints) joint = Upright(joint, up);
  return pose;
}

glm::dvec3 BodyAxis(const BodyPose& pose) {
  const glm::dvec3 axis = pose[kHead] - 0.5 * (pose[kLeftAnkle] + pose[kRightAnkle]);
  const double length = glm::length(axis);
  return length > 0 ? axis / length : glm::dvec3(0);
}

glm::dvec3 MeanBodyAxis(std::span<const BodyPose> poses) {
  glm::dvec3 sum(0);
  for (const BodyPose& pose : poses) sum += BodyAxis(pose);
  return sum / static_cast<double>(poses.size());
}

UpAxis FindUpAxis(const BodyPose& rest, std::span<const BodyPose> poses) {
  const glm::dvec3 at_rest = BodyAxis(rest);
  const glm::dvec3 moving = MeanBodyAxis(poses);
  if (at_rest.z > kStanding) return moving.y > kStanding ? UpAxis::kY : UpAxis::kZ;
  if (at_rest.y > kStanding) {
    return moving.z > kStanding && TravelsOverXY(poses) ? UpAxis::kZ : UpAxis::kY;
  }
  return moving.z > kMostlyStanding && moving.z > std::abs(moving.y) ? UpAxis::kZ : UpAxis::kY;
}

}  // namespace etude
