#pragma once

#include <optional>
#include <vector>

#include "engine/capture/bridge_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// Paper B as it happens: each skeleton from the marks up to its frame alone. What a frame lacks comes from those
/// before it (`BridgeLast`); no later frame corrects it.
class LiveRecovery {
 public:
  /// `body` must outlive this.
  LiveRecovery(const CaptureBody& body, const RecoverOptions& recover, const BridgeOptions& bridge);

  /// The next marked frame. Nothing while too little was seen.
  std::optional<RecoveredFrame> Next(const FrameMeasurement& measured, const KnownAngles& known = {});

 private:
  const BridgeOptions bridge_;
  FrameRecovery recovery_;
  std::vector<FrameMeasurement> latest_;  ///< as many as can be bridged
};

}  // namespace etude
