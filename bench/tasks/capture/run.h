#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/stages.h"
#include "engine/base/result.h"
#include "engine/capture/interpolate_gaps.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"

namespace etude {

/// The results of all stages of a built-in method in a world. The references point into the CaptureStages on which the
/// method was run.
struct CaptureRun {
  const CaptureMethod& method;
  const CalibratedCameras& cameras;
  const Take& take;
  const Observation& observation;
  const MeasuredTake& measured;
  CaptureBody body;  ///< the body whose poses `frames` holds
  std::vector<std::optional<RecoveredFrame>> frames;
};

/// Returns the options with which RecoverFrames runs this method.
RecoverOptions RecoverOptionsOf(const CaptureMethod& method);

/// Returns the options for bridging gaps in a live method. A live method receives marked frames only, so the options
/// count marked frames instead of all frames. `max_gap` is therefore smaller, and `turn_per_frame` larger.
GapOptions LiveGapOptions(const StudioOptions& options);

/// Returns the body with which a method begins. Its limb lengths are known, or are measured from the marks. Fails, with
/// the reason, if no body can be made.
Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run);

/// Recovers and smooths the run's frames by its method. Bundle adjustment of paper B's body also refines the limb
/// lengths if they were measured.
Result<void> Recover(CaptureStages& stages, CaptureRun& run);

/// Runs one method in one world. Fails, with the reason, if a camera cannot be calibrated, if there is no renderer, or
/// if no body can be made or measured.
Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method);

}  // namespace etude
