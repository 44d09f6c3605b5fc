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

/// A stationary random process with three independent axes of unit variance: white noise filtered by one first-order
/// low pass (Ornstein–Uhlenbeck, autocorrelation exp(−t/τ)) or by two.
class SlowNoise {
 public:
  /// Starts in the stationary distribution. `time_s` is the longer time constant and `smoothing_s` the shorter one; if
  /// `smoothing_s` is 0, there is a single low pass.
  SlowNoise(double time_s, double smoothing_s, double rate_hz, RandomStream& dice);

  /// Returns the next frame's value; uses three normal draws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double memory_, novelty_, smoothing_, scale_;
  glm::dvec3 first_{0}, second_{0};
};

/// Fast noise in bursts, with unit variance over long times and heavy tails: the kurtosis is 3 exp(4 tail²).
class BurstNoise {
 public:
  BurstNoise(double time_s, double tail, double rate_hz, RandomStream& dice);

  /// Returns the next frame's value; uses six normal draws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double tail_;
  SlowNoise noise_, loudness_;
};

/// The correlation lengths of a joint's error: the distances, metres, by which joints must move before the error is
/// different.
struct PoseLengths {
  double own = 0.25;  ///< length for movements of the joint itself or of the next joint of its limb
  double far = 0.8;   ///< length for movements of the arms; used in the errors of trunk and legs
};

/// A smooth random function of the pose for one joint, with a standard normal distribution along each axis. The
/// function is a sum of random waves over the positions of the joint, its limb and the arms, so equal poses have equal
/// values.
class PoseField {
 public:
  PoseField(Role role, const PoseLengths& lengths, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;
  /// Returns true if At(pose).x exceeds `threshold`, usually without computing a cosine exactly.
  bool ExceedsAlongX(const BodyPose& pose, double threshold) const;

 private:
  static constexpr int kWaves = 12;
  static constexpr std::size_t kMaxPoints = 5;
  /// A joint position that is an argument of the function, relative to the shoulder centre or in the world.
  struct Point {
    Role joint;
    bool from_shoulders;
    double length;
  };
  struct Wave {
    glm::dvec3 direction;
    std::array<glm::dvec3, kMaxPoints> per_metre;
    double phase;
  };
  std::array<double, kWaves> PhasesAt(const BodyPose& pose) const;

  std::array<Point, kMaxPoints> points_{};
  std::size_t point_count_ = 0;
  std::array<Wave, kWaves> waves_;
};

/// The error of one joint as a function of the pose. Its mean square is 1 on each axis; it jumps between two modes.
class PoseError {
 public:
  PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;

 private:
  PoseField usual_, in_mode_, preference_;
  double usual_size_ = 1, mode_size_ = 1, threshold_ = 0;
};

/// For each joint, the reported position minus the true position, metres, in the world.
using FrameErrors = std::array<glm::dvec3, kRoleCount>;

/// The continuous errors of clearly seen joints, frame by frame. A joint's error is ρ times its parent's error plus √(1
/// − ρ²) times an independent part, the joint's own error. In this sum, errors are divided by the error size of the
/// joint's group (`GroupErrors`), along and across the line of sight. A joint's own error depends on the pose; a share
/// of the own error's variance is fast and comes in bursts. The slow drift of a body at rest is added joint by joint.
class ContinuousErrors {
 public:
  /// `rate_hz` must be positive.
  ContinuousErrors(const Camera& sensor, const SkeletonSensorOptions& options, double rate_hz, const WorldKey& world);

  /// Returns the errors of the next frame. For every pose, the same number of random numbers is drawn.
  FrameErrors Next(const BodyPose& pose, const FrameMotion& motion);

 private:
  /// The random processes of one joint.
  struct JointNoise {
    PoseError by_pose;
    BurstNoise fast;
    SlowNoise wander;
    SlowNoise resting;
  };

  Camera sensor_;
  SkeletonSensorOptions options_;
  RandomStream wander_dice_, pose_dice_, fast_dice_, rest_dice_;
  std::vector<JointNoise> noises_;  ///< one entry per role
};

}  // namespace etude
