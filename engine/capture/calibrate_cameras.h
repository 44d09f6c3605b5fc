#pragma once

#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/dlt.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"
#include "engine/vision/strokes.h"

namespace etude {

struct CalibrationOptions {
  /// The calibration method, by default paper B's. Use `kDltNormalised` if there are few or noisy point pairs, or if
  /// the points are far from the world's origin: this method scales the equations, so that pairs with larger numbers do
  /// not get more weight. For `kRefined`, call `RefineCameras` instead.
  Calibration method = Calibration::kDlt;
};

/// Computes the matrix H of every camera (paper B, section 2.2) from its point pairs `pairs[camera]`. A camera with a
/// known matrix needs no pairs (`MatrixOf`); `ReprojectionRms` tells how well a matrix fits. Fails if the pairs of a
/// camera do not determine its matrix; the message names the first such camera, counted from 1: "camera 2: …".
Result<std::vector<ProjectionMatrix>> CalibrateCameras(std::span<const std::vector<PointPair>> pairs,
                                                       const CalibrationOptions& options = {});

/// Calibrates every camera with its lens distortion by minimising the squared reprojection error (`RefineCamera`).
/// Fails like `CalibrateCameras`.
/// @param sizes the picture size of each camera
Result<std::vector<Camera>> RefineCameras(std::span<const std::vector<PointPair>> pairs,
                                          std::span<const PictureSize> sizes, const RefineOptions& options = {});

/// Returns the marks as the camera would show them without lens distortion. A mark outside the field of the lens is
/// left out. `MeasureInputs` takes such marks, with the matrix that `MatrixOf` returns for the camera.
Marks UndistortMarks(const Camera& camera, const Marks& marks);

}  // namespace etude
