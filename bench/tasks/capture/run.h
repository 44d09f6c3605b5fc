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

/// The results of every stage of a built-in method in a world. References point into the CaptureStages on which it was
/// run.
struct CaptureRun {
  const CaptureMethod& method;
  const CalibratedCameras& cameras;
  const Take& take;
  const Observation& observation;
  const MeasuredTake& measured;
  CaptureBody body;  ///< the body of `frames`
  std::vector<std::optional<RecoveredFrame>> frames;
};

/// Returns the options of RecoverFrames for this method.
RecoverOptions RecoverOptionsOf(const CaptureMethod& method);

/// Returns the limits on gaps for a live method, which sees marked frames only: the same durations as in a take in
/// which every frame is marked.
BridgeOptions LiveBridgeOptions(const StudioOptions& options);

/// Returns the body that a method begins with: known, or with limb lengths measured from what it sees. Fails, saying
/// why, if none can be made.
Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run);

/// Fills the run's frames as its method recovers and smooths them. Bundle adjustment of paper B's body with measured
/// lengths also refines these lengths.
Result<void> Recover(CaptureStages& stages, CaptureRun& run);

/// Runs one method in one world. Fails, saying why, if a camera cannot be calibrated, there is no renderer, or no body
/// can be made or measured.
Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method);

}  // namespace etude
