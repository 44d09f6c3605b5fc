#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

/// A point Q, measured in the world (metres), and the pixel that shows it.
struct PointPair {
  glm::dvec3 world{0};  ///< p_WQ
  glm::dvec2 pixel{0};
};

enum class Calibration {
  kDlt,            ///< "dlt": least squares on H's entries, |H| = 1 (paper B, section 2.2)
  kDltNormalised,  ///< "dlt-normalised": the same after Hartley's shift and scale of both point sets
  /// "refined": from there, the camera with its lens of least squared reprojection error. More than a matrix:
  /// `RefineCamera` (refine.h); `Calibrate` gives the matrix that it starts from.
  kRefined,
};

/// Returns the names used in scenarios: "dlt", "dlt-normalised", "refined".
std::vector<std::string> CalibrationNames();
/// Returns the calibration of that name, which is one of CalibrationNames().
Calibration CalibrationNamed(std::string_view name);

/// Computes the projection matrix that maps the pairs' world points to their pixels, by the direct linear transform.
/// The result is scaled such that w is the depth in metres, positive in front of the camera. Fails, saying why, when
/// the pairs do not determine a camera: fewer than six, a number that is not finite, world points (nearly) in one plane
/// or on one line, or pairs that no camera can have seen.
Result<ProjectionMatrix> Calibrate(std::span<const PointPair> pairs, Calibration calibration);

/// Returns the root mean square distance between the pixels and the projected world points, pixels; infinity when
/// `matrix` does not show some point.
double ReprojectionRms(const ProjectionMatrix& matrix, std::span<const PointPair> pairs);

}  // namespace etude
