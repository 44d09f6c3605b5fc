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

/// Returns the limits on gaps for a live method. It sees marked frames only, so the limits are counted in these, with
/// the same durations as if every frame were marked.
BridgeOptions LiveBridgeOptions(const StudioOptions& options);

/// Returns the body that a method begins with, with known limb lengths or with lengths measured from its marks. Fails
/// with the reason if none can be made.
Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run);

/// Recovers and smooths the run's frames by its method. Bundle adjustment of paper B's body with measured lengths also
/// refines these lengths.
Result<void> Recover(CaptureStages& stages, CaptureRun& run);

/// Runs one method in one world. Fails, with the reason, if a camera cannot be calibrated, there is no renderer, or no
/// body can be made or measured.
Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method);

}  // namespace etude
