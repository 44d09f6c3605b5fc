#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

enum class Calibration {
  kDlt,            ///< "dlt": least squares on H's entries, |H| = 1 (paper B, section 2.2)
  kDltNormalised,  ///< "dlt-normalised": "dlt" after Hartley's shift and scale of pixels and world points
  /// "refined": starting from "dlt-normalised", minimises the squared reprojection error over the camera and its lens.
  /// `RefineCamera` (refine.h) computes this result, which includes the lens; `Calibrate` returns only the start matrix
  /// for this method.
  kRefined,
};

/// Returns the names used in scenarios: "dlt", "dlt-normalised", "refined".
std::vector<std::string> CalibrationNames();
/// Returns the calibration with the name `name`, which must be one of CalibrationNames().
Calibration CalibrationNamed(std::string_view name);

/// Computes the projection matrix that maps the pairs' world points to their pixels, by the direct linear transform.
/// The result is scaled so that w is the depth in metres, positive in front of the camera. Fails, with the reason, if
/// the pairs do not determine a camera: fewer than six pairs, a number that is not finite, world points (nearly) in one
/// plane or on one line, or pairs that no camera can have seen.
Result<ProjectionMatrix> Calibrate(std::span<const PointPair> pairs, Calibration calibration);

/// Returns the root mean square distance between the pixels and the projected world points, pixels; infinity if
/// `matrix` cannot project some point.
double ReprojectionRms(const ProjectionMatrix& matrix, std::span<const PointPair> pairs);

}  // namespace etude
