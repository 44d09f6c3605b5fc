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
  /// The method, paper B's by default. Use `kDltNormalised` when point pairs are few or noisy, or far from the world's
  /// origin: its equations are scaled alike, so that no pair counts more because its numbers are larger. `kRefined`
  /// asks for `RefineCameras`.
  Calibration method = Calibration::kDlt;
};

/// Computes the matrix H of every camera (paper B, section 2.2) from the point pairs measured for it, `pairs[camera]`.
/// A camera whose matrix is known needs no pairs: `MatrixOf`. How well a matrix fits: `ReprojectionRms`. Fails for the
/// first camera whose pairs do not determine it, and names it, counted from 1: "camera 2: …".
Result<std::vector<ProjectionMatrix>> CalibrateCameras(std::span<const std::vector<PointPair>> pairs,
                                                       const CalibrationOptions& options = {});

/// Calibrates every camera with its lens, by least squared reprojection error (`RefineCamera`).
/// @param sizes of the cameras' pictures, one each
Result<std::vector<Camera>> RefineCameras(std::span<const std::vector<PointPair>> pairs,
                                          std::span<const PictureSize> sizes, const RefineOptions& options = {});

/// Returns the marks as the camera would show them without its lens's distortion, which is what `MeasureInputs` takes
/// beside `MatrixOf`. A mark outside of what the lens can show is missing.
Marks UndistortMarks(const Camera& camera, const Marks& marks);

}  // namespace etude
