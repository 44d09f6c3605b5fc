#pragma once

#include "engine/base/result.h"
#include "engine/capture/bridge_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/recover_frames.h"

namespace etude {

struct CaptureInputs {
  MeasureInputs pictures;
  CaptureBody body;               ///< of the person, measured beforehand
  std::vector<bool> marked = {};  ///< `RecoverInputs::marked`: one per frame, or empty when all frames were marked
};

struct CaptureOptions {
  MeasureOptions measure;
  BridgeOptions bridge;
  RecoverOptions recover;  ///< its solver is needed
};

/// What every stage made of the pictures, one entry per frame.
struct CapturedMotion {
  std::vector<FrameMeasurement> measured;
  std::vector<std::optional<LimbObservation>> seen;
  std::vector<std::optional<RecoveredFrame>> frames;
};

/// Paper B from marked pictures to a motion: MeasureFrames, BridgeGaps, RecoverFrames. Frames of which too little was
/// seen stay empty, be it all of them; HoldFrames and ToClip make a clip of the others. Fails, saying why, when inputs
/// do not fit together: fewer than two cameras, not as many lists of marks as cameras, lists of different lengths, a
/// body with limb lengths that are not positive, no solver. For programs that link this folder alone, as its test does;
/// task `capture` shares stages between methods and calls them one by one.
Result<CapturedMotion> CaptureMotion(const CaptureInputs& inputs, const CaptureOptions& options);

}  // namespace etude
