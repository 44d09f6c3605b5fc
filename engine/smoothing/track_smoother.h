#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace etude {

/// A measurement of a moving point in one frame. `information` is the inverse of the error's covariance, 1/m²:
/// zero when nothing is seen, of rank 2 when the point is known to lie on a line.
struct PointMeasurement {
  glm::dvec3 position{0};  ///< metres
  glm::dmat3 information{0};
};

/// The assumed motion of a point: white acceleration drives a velocity that is forgotten by and by (an integrated
/// Ornstein–Uhlenbeck process), so that a point lost in full swing comes to rest and does not fly away.
struct PointMotion {
  double frame_s = 1.0 / 30;  ///< seconds from frame to frame
  /// The spectral density of the acceleration along each axis, m²/s³: in a short time t the velocity's variance grows
  /// by this · t. A trunk's is about 1, a hand's 100.
  double acceleration_density = 10;
  /// The time in which a velocity falls to 1/e, seconds. Limbs turn back about twice a second *(ours)*. Very long:
  /// constant velocity.
  double velocity_memory_s = 0.5;
  /// The standard deviations of the state before the first frame, about the origin at rest: metres and m/s, so large
  /// that any measurement outweighs them.
  double first_position_m = 100;
  double first_velocity_mps = 10;
};

struct SmoothedTrack {
  std::vector<glm::dvec3> positions;    ///< metres, given the measurements of all frames
  std::vector<glm::dvec3> velocities;   ///< m/s
  std::vector<glm::dmat3> covariances;  ///< of the positions, m²
  double log_likelihood = 0;            ///< of the measurements under this motion, natural logarithm
};

/// Smooths a track by Rauch, Tung and Striebel's method (1965): a Kalman filter forwards, then backwards what later
/// frames say of earlier ones. The mean of the state given all measurements, which is also the least-squares solution
/// over all frames.
SmoothedTrack SmoothTrack(std::span<const PointMeasurement> measurements, const PointMotion& motion);

/// Returns the acceleration density under which the measurements are likeliest, of 0.01 · 4ᵏ m²/s³, k = 0…9; the
/// smallest of equals.
double LikeliestAccelerationDensity(std::span<const PointMeasurement> measurements, const PointMotion& motion);

}  // namespace etude
