#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace etude {

/// A measurement of a moving point in one frame. `information` is the inverse covariance of the measurement's error,
/// 1/m²: zero if the point is not seen, of rank 2 if only a line through the point is known.
struct PointMeasurement {
  glm::dvec3 position{0};  ///< metres
  glm::dmat3 information{0};
};

/// The motion model of a point: white acceleration drives a velocity that decays exponentially (an integrated
/// Ornstein–Uhlenbeck process). A point that is lost in full motion therefore comes to rest instead of moving away.
struct PointMotion {
  double frame_s = 1.0 / 30;  ///< seconds from frame to frame
  /// The spectral density q of the acceleration along each axis, m²/s³: in a short time t the variance of the velocity
  /// grows by q · t. Typical values are 1 for a trunk and 100 for a hand.
  double acceleration_density = 10;
  /// The time constant of the velocity's decay, seconds. The default suits limbs, whose velocity reverses about twice a
  /// second *(ours)*. A very large value means constant velocity.
  double velocity_memory_s = 0.5;
  /// The standard deviations of the prior of the first state, metres and m/s; the prior's mean is a point at rest at
  /// the origin. These deviations are so large that any measurement outweighs the prior.
  double first_position_m = 100;
  double first_velocity_mps = 10;
};

struct SmoothedTrack {
  std::vector<glm::dvec3> positions;    ///< metres, expected values given the measurements of all frames
  std::vector<glm::dvec3> velocities;   ///< m/s
  std::vector<glm::dmat3> covariances;  ///< covariances of the positions, m²
  double log_likelihood = 0;            ///< natural logarithm of the measurements' likelihood by the motion model
};

/// Smooths a track by the method of Rauch, Tung and Striebel (1965): a Kalman filter forwards, then a backward pass
/// that corrects earlier frames by later frames. The result is the mean of the state given all measurements; it is also
/// the least-squares solution over all frames.
SmoothedTrack SmoothTrack(std::span<const PointMeasurement> measurements, const PointMotion& motion);

/// Returns the acceleration density among 0.01 · 4ᵏ m²/s³, k = 0…9, that has the maximum likelihood; of equally likely
/// densities, the smallest.
double LikeliestAccelerationDensity(std::span<const PointMeasurement> measurements, const PointMotion& motion);

}  // namespace etude
