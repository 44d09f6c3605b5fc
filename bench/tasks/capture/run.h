#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/stages.h"
#include "engine/base/result.h"
#include "engine/capture/bridge_gaps.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"

namespace etude {

/// The results of every stage of a built-in method in a world. References lead into the CaptureStages that it was run
/// on.
struct CaptureRun {
  const CaptureMethod& method;
  const CalibratedCameras& cameras;
  const Take& take;
  const Observation& observation;
  const MeasuredTake& measured;
  CaptureBody body;  ///< of `frames`
  std::vector<std::optional<RecoveredFrame>> frames;
};

RecoverOptions RecoverOptionsOf(const CaptureMethod& method);

/// The limits on gaps for a live method, whose frames are the marked ones alone: the same times as in a take that is
/// marked throughout.
BridgeOptions LiveBridgeOptions(const StudioOptions& options);

/// The body that a method begins with: known, or of limb lengths that are measured from what it sees. Fails, saying
/// why, when none can be made.
Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run);

/// Fills the run's frames as its method recovers and smooths them; bundle adjustment of paper B's body with measured
/// lengths goes on measuring them.
Result<void> Recover(CaptureStages& stages, CaptureRun& run);

/// Runs one method in one world. Fails, saying why, when a camera cannot be calibrated, there is no renderer, or no
/// body can be made or measured.
Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method);

}  // namespace etude
