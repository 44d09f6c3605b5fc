#pragma once

#include <optional>
#include <span>

#include "engine/cameras/dlt.h"

namespace etude {

/// A measurement in one frame and its true value. Either may be missing.
struct MeasuredAndTrue {
  std::optional<glm::dvec3> found;
  std::optional<glm::dvec3> truth;
};

/// The mean error of measurements, and the coverage: the share of true values that were measured.
struct MeasuredError {
  std::optional<double> mean;      ///< mean error over all measured values; empty if there are none
  std::optional<double> coverage;  ///< share of the true values that were measured; empty if there are none
};

/// Returns the mean angle between the measured and the true direction, degrees (`limb_direction_error_deg`), and the
/// coverage (`limb_direction_coverage`). `limbs` has one entry per limb and frame; directions need not be unit vectors.
MeasuredError LimbDirectionErrorDeg(std::span<const MeasuredAndTrue> limbs);

/// Returns the mean distance between the triangulated and the true point, millimetres (`triangulation_error_mm`), and
/// the coverage (`triangulation_coverage`). `ends` has one entry per end effector and frame, in metres.
MeasuredError TriangulationErrorMm(std::span<const MeasuredAndTrue> ends);

/// A calibrated camera and the point pairs it was calibrated from.
struct CameraFit {
  ProjectionMatrix matrix;
  std::span<const PointPair> pairs;
};

/// Returns `reprojection_rms_px`: the root mean square reprojection error of each camera, pixels, averaged over the
/// cameras. At least one camera is required. Returns infinity if a point lies behind a camera.
double MeanReprojectionRmsPx(std::span<const CameraFit> cameras);

}  // namespace etude
