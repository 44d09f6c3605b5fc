#pragma once

#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/dlt.h"

namespace etude {

struct CalibrationOptions {
  /// Paper B's by default. Use `kDltNormalised` when point pairs are few or noisy, or far from the world's origin: its
  /// equations are scaled alike, so that no pair counts more because its numbers are larger.
  Calibration method = Calibration::kDlt;
};

/// The matrix H of every camera (paper B, section 2.2) from the point pairs measured for it, `pairs[camera]`.
/// A camera whose matrix is known needs no pairs: `MatrixOf`. How well a matrix fits: `ReprojectionRms`.
/// Fails for the first camera whose pairs do not determine it, and names it, counted from 1: "camera 2: …".
Result<std::vector<ProjectionMatrix>> CalibrateCameras(std::span<const std::vector<PointPair>> pairs,
                                                       const CalibrationOptions& options = {});

}  // namespace etude
