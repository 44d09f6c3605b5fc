#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"

namespace etude {

/// The uncertainty of a rig's calibration: standard deviations, the same for all cameras and independent of each other.
struct CalibrationDeviation {
  double place_m = 0;  ///< deviation of a camera's centre along each axis, metres
  double turn = 0;     ///< deviation of a camera's orientation about each of its axes, radians
  double focal = 0;    ///< relative deviation of a camera's focal length

  friend bool operator==(const CalibrationDeviation&, const CalibrationDeviation&) = default;
};

/// The errors of the pixels from which a point is triangulated.
struct SightingErrors {
  double noise_px = 5;  ///< standard deviation of a pixel's error along each axis of the picture
  double dropout = 0;   ///< probability, below 1, that a camera gives no pixel for a point in its picture
  CalibrationDeviation calibration = {};
};

/// The maximum number of cameras if `dropout` is not 0, because all 2ⁿ combinations of n cameras are summed up.
constexpr std::size_t kMaxDroppingCameras = 10;

/// The number of calibration parameters of one camera: three rotations, three coordinates, one focal length.
constexpr std::size_t kCalibrationParameters = 7;

/// The expected error of one triangulated point.
struct PointError {
  int cameras = 0;  ///< number of cameras that have the point in their pictures
  /// The probability that the point cannot be triangulated. If it can be triangulated, the members below describe its
  /// error.
  double lost = 1;
  glm::dmat3 covariance{0};  ///< covariance of the position, m²
  glm::dmat3 noise{0};       ///< the part of `covariance` due to the pixels' noise
  /// For each camera, the mean displacement of the position, metres, that one standard deviation of each calibration
  /// parameter causes. A calibration error displaces all points of a take, so the errors of different points are
  /// correlated.
  std::vector<std::array<glm::dvec3, kCalibrationParameters>> displacements = {};

  /// The root mean square distance from the true position, metres.
  double Rms() const;
};

/// Computes, to first order, the expected error of the position that minimises the sum of squared pixel distances
/// (`TriangulateLikeliest`, equal weights). The covariance of the position is K S Kᵀ with K = (JᵀJ)⁻¹Jᵀ. Here J holds
/// the derivatives of the pixels with respect to the position. S is the covariance of the pixels: their noise after the
/// lens distortion is removed, plus the effect of the calibration's deviations. If `dropout` is not 0, the error is a
/// mean over all combinations of cameras that give a pixel, weighted by the combinations' probabilities. If fewer than
/// two cameras have the point in their pictures, or if all lines of sight are parallel, `lost` is 1. Precondition: at
/// most kMaxDroppingCameras cameras if `dropout` is not 0.
PointError ExpectedPointError(std::span<const Camera> cameras, const glm::dvec3& p_WQ, const SightingErrors& errors);

/// Returns true if the camera has the point in its picture.
bool HasInPicture(const Camera& camera, const glm::dvec3& p_WQ);

}  // namespace etude
