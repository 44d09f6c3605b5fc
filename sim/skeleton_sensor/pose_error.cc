#include "sim/skeleton_sensor/pose_error.h"

#include <cmath>

namespace etude {
namespace {

/// The standard normal value that is exceeded with this probability, in (0, 1).
double NormalQuantileAbove(double probability) {
  double low = -9, high = 9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PoseLengths LengthsOf(const SkeletonSensorOptions& options) {
  return {.own = options.pose_length_m, .far = options.far_pose_length_m};
}

}  // namespace

PoseError::PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice)
    : usual_(role, LengthsOf(options), dice),
      in_mode_(role, LengthsOf(options), dice),
      preference_(role, LengthsOf(options), dice) {
  const double q = options.mode_share, r = options.mode_ratio;
  usual_size_ = 1 / std::sqrt(1 - q + q * r * r);
  mode_size_ = r * usual_size_;
  threshold_ = NormalQuantileAbove(q);
}

glm::dvec3 PoseError::At(const BodyPose& pose) const {
  const bool mode = preference_.At(pose).x > threshold_;
  return mode ? mode_size_ * in_mode_.At(pose) : usual_size_ * usual_.At(pose);
}

}  // namespace etude
