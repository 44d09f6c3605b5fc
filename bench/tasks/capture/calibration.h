#pragma once

#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/cameras/dlt.h"
#include "sim/render/renderer.h"

namespace etude {

/// What each camera is calibrated with: places of the world, as they were measured, and where its picture shows them.
using CalibrationPairs = std::vector<std::vector<PointPair>>;

/// Points stuck on three walls of a box about the stage (paper B, section 2.2: "on different planes"), clicked by a
/// human with an error of `calibration_noise_px`, and measured with one of `calibration_measure_mm`.
CalibrationPairs ClickedPoints(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

/// The discs of a cube (sim/rig/calibration_target.h), found in a picture that each camera takes of it with all that
/// its optics and sensor do: where a human has pointed, with an error of `calibration_noise_px`. Each is measured by
/// itself. Discs seen from more than 70° aside are left alone, as are those that are not found.
CalibrationPairs FoundMarks(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                            Renderer& renderer);

/// The corners of a cube of boards (sim/rig/calibration_target.h), found in a picture that each camera takes of it with
/// all that its optics and sensor do. A board is measured as a whole: all its corners are off alike.
CalibrationPairs FoundCorners(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                              Renderer& renderer);

}  // namespace etude
