#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/stages.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"

namespace etude {

/// What every stage of a built-in method made of a world. References lead into the CaptureStages that it was run on.
struct CaptureRun {
  const CaptureMethod& method;
  const CalibratedCameras& cameras;
  const Take& take;
  const Observation& observation;
  const MeasuredTake& measured;
  CaptureBody body;  ///< of `frames`
  std::vector<std::optional<RecoveredFrame>> frames;
};

/// Runs one method in one world. Fails, saying why, when a camera cannot be calibrated, there is no renderer, or no
/// body can be made or measured.
Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method);

}  // namespace etude
