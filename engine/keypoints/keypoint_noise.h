#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "engine/cameras/camera.h"
#include "engine/cameras/robust_triangulation.h"
#include "engine/keypoints/match_people.h"
#include "engine/motion/body.h"

namespace etude {

/// The random error of one person's keypoints: standard deviations along each axis of the picture, px.
struct KeypointNoise {
  double all_px = 0;                                       ///< the deviation of all landmarks together
  std::array<std::optional<double>, kLandmarkCount> px{};  ///< the deviation of each landmark with at least 30 points
  std::size_t points = 0;                                  ///< number of triangulated points

  /// Returns the deviation of the landmark at a joint; the deviation of all landmarks if the joint has no landmark or
  /// its landmark has too few points.
  double Of(Role role) const;
};

/// Estimates the variance of keypoints along each axis, px², from the residuals of one point. If n cameras agree on a
/// point, the point's sum of squared reprojection errors is distributed as σ²χ² with 2n − 3 degrees of freedom. The
/// result is this sum divided by the median of that χ² (Wilson and Hilferty 1931), so the median of the results for
/// many points is σ².
double KeypointVarianceOf(const RobustPoint& point);

/// Measures the random error of keypoints by how well the cameras agree: σ² is the median of KeypointVarianceOf over
/// all points, triangulated with equal weights. Errors that all cameras share are not included; errors of a wrong
/// calibration are. Returns nullopt if no point is found. *(Ours.)*
/// @param cameras the cameras of the rig, without lens distortion; all pixels must be undistorted
/// @param outlier_px keypoints farther than this from the projected point are left out (`RobustOptions`)
std::optional<KeypointNoise> MeasureKeypointNoise(std::span<const ProjectionMatrix> cameras,
                                                  const MatchedPerson& person, double min_confidence,
                                                  double outlier_px);

}  // namespace etude
