#pragma once

#include <optional>
#include <span>

#include "engine/cameras/dlt.h"

namespace etude {

/// One thing in one frame: what was measured of it, and the truth, where there is one of each.
struct Sighted {
  std::optional<glm::dvec3> found;
  std::optional<glm::dvec3> truth;
};

/// The errors of measurements against the truth, and how many measurements there are.
struct MeasuredError {
  std::optional<double> mean;      ///< over what was measured; empty when nothing was
  std::optional<double> coverage;  ///< share of what has a truth that was measured; empty when nothing has
};

/// Angle between the direction read and the true one, degrees: `limb_direction_error_deg`, `limb_direction_coverage`.
/// One entry per limb and frame; directions need no length of one.
MeasuredError LimbDirectionErrorDeg(std::span<const Sighted> limbs);

/// Distance of a point found to the true one, millimetres: `triangulation_error_mm`, `triangulation_coverage`. One
/// entry per end effector and frame, metres.
MeasuredError TriangulationErrorMm(std::span<const Sighted> ends);

/// A calibrated camera and the points that it was calibrated by.
struct CameraFit {
  ProjectionMatrix matrix;
  std::span<const PointPair> pairs;
};

/// `reprojection_rms_px`: each camera's root mean square distance between measured and reprojected pixels, then the
/// mean over the cameras. Needs a camera; infinite when a point lies behind one.
double MeanReprojectionRmsPx(std::span<const CameraFit> cameras);

}  // namespace etude
