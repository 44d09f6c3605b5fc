#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/motion_window.h"
#include "sim/skeleton_sensor/options.h"
#include "sim/skeleton_sensor/pose_error.h"
#include "sim/skeleton_sensor/processes.h"

namespace etude {

/// How far each joint of a frame is reported from where it is, metres, in the world.
using FrameErrors = std::array<glm::dvec3, kRoleCount>;

/// The continuous errors of plainly seen joints, frame by frame. In units of its group's size, and along the line of
/// sight and two axes across it, a joint's error is ρ times its parent's and √(1 − ρ²) of its own; its own depends on
/// the pose, with a share that is fast and comes in bursts. To that comes the wander of a body at rest, joint by joint.
class ContinuousErrors {
 public:
  /// `rate_hz` > 0.
  ContinuousErrors(const Camera& sensor, const SkeletonSensorOptions& options, double rate_hz, const WorldKey& world);

  /// Of the next frame; as many throws whatever the pose.
  FrameErrors Next(const BodyPose& pose, const FrameMotion& motion);

 private:
  /// The dice of one joint, and what they have come to.
  struct JointNoise {
    PoseError by_pose;
    BurstNoise fast;
    SlowNoise wander;
    SlowNoise resting;
  };

  Camera sensor_;
  SkeletonSensorOptions options_;
  RandomStream wander_dice_, pose_dice_, fast_dice_, rest_dice_;
  std::vector<JointNoise> noises_;  ///< by role
};

}  // namespace etude
