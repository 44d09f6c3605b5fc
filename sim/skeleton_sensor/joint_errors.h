#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/live_sensor.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// A stationary process of three independent axes, each of unit variance: white noise through one first-order low
/// pass (Ornstein–Uhlenbeck, correlation exp(−t/τ)), or through two.
class SlowNoise {
 public:
  /// Starts stationary. `time_s` is the longer time constant, `smoothing_s` the shorter; 0 means a single low pass.
  SlowNoise(double time_s, double smoothing_s, double rate_hz, RandomStream& dice);

  /// Returns the next frame's value; takes three throws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double memory_, smoothing_, scale_;
  glm::dvec3 first_{0}, second_{0};
};

/// Short noise in bursts, of unit variance over long times and with heavy tails. Kurtosis 3 exp(4 tail²).
class BurstNoise {
 public:
  BurstNoise(double time_s, double tail, double rate_hz, RandomStream& dice);

  /// Returns the next frame's value; takes six throws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double tail_;
  SlowNoise noise_, loudness_;
};

/// The distances over which a joint's error changes, metres.
struct PoseLengths {
  double own = 0.25;  ///< moving the joint itself, or the next joint of its limb
  double far = 0.8;   ///< moving the arms, for joints of the trunk and legs
};

/// A random function of the pose, for one joint: unit normal along each axis, smooth, and the same whenever the pose
/// comes back. (A sum of random waves over the places of the joint, of its limb and of the arms.)
class PoseField {
 public:
  PoseField(Role role, const PoseLengths& lengths, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;

 private:
  static constexpr int kWaves = 12;
  static constexpr std::size_t kMostPlaces = 5;
  /// A place that the function depends on: of one joint, from another or in the world.
  struct Seen {
    Role joint;
    bool from_shoulders;
    double length;
  };
  struct Wave {
    glm::dvec3 direction;
    std::array<glm::dvec3, kMostPlaces> per_metre;
    double phase;
  };
  std::array<Seen, kMostPlaces> seen_{};
  std::size_t seen_count_ = 0;
  std::array<Wave, kWaves> waves_;
};

/// The error of one joint as a function of the pose: unit mean square per axis, with jumps where the mode changes.
class PoseError {
 public:
  PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;

 private:
  PoseField usual_, in_mode_, preference_;
  double usual_size_ = 1, mode_size_ = 1, threshold_ = 0;
};

/// The offset of each joint of a frame from its true to its reported place, metres, in the world.
using FrameErrors = std::array<glm::dvec3, kRoleCount>;

/// The continuous errors of plainly seen joints, frame by frame. In units of its group's size, and along the line of
/// sight and two axes across it, a joint's error is ρ times its parent's and √(1 − ρ²) of its own; its own depends on
/// the pose, with a share that is fast and comes in bursts. To that comes the wander of a body at rest, joint by joint.
class ContinuousErrors {
 public:
  /// `rate_hz` > 0.
  ContinuousErrors(const Camera& sensor, const SkeletonSensorOptions& options, double rate_hz, const WorldKey& world);

  /// Returns the errors of the next frame; takes as many throws whatever the pose.
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
