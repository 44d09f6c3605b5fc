#pragma once

#include <glm/glm.hpp>

#include "engine/motion/body.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"
#include "sim/skeleton_sensor/pose_field.h"

namespace etude {

/// Which error of one joint goes with a pose: unit mean square per axis, with jumps where the mode changes.
class PoseError {
 public:
  PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;

 private:
  PoseField usual_, in_mode_, preference_;
  double usual_size_ = 1, mode_size_ = 1, threshold_ = 0;
};

}  // namespace etude
