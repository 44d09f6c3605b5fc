#pragma once

#include "bench/tasks/capture/run.h"
#include "bench/tasks/capture/stages.h"
#include "engine/base/result.h"
#include "engine/capture/bridge_gaps.h"
#include "engine/capture/recover_frames.h"

namespace etude {

RecoverOptions RecoverOptionsOf(const CaptureMethod& method);

/// Of a live method, whose frames are the marked ones alone: the same times as those of a take marked throughout.
BridgeOptions LiveBridgeOptions(const StudioOptions& options);

/// The body that a method begins with: known, or of limb lengths that are measured from what it sees. Fails, saying
/// why, when none can be made.
Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run);

/// Fills the run's frames as its method recovers and smooths them; bundle adjustment of paper B's body with measured
/// lengths goes on measuring them.
Result<void> Recover(CaptureStages& stages, CaptureRun& run);

}  // namespace etude
