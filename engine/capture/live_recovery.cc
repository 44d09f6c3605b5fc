#include "engine/capture/live_recovery.h"

namespace etude {

LiveRecovery::LiveRecovery(const CaptureBody& body, const RecoverOptions& recover, const BridgeOptions& bridge)
    : bridge_(bridge), recovery_(body, recover) {}

std::optional<RecoveredFrame> LiveRecovery::Next(const FrameMeasurement& measured, const KnownAngles& known) {
  if (latest_.size() > static_cast<std::size_t>(bridge_.longest_gap)) latest_.erase(latest_.begin());
  latest_.push_back(measured);
  return recovery_.Next(BridgeLast(latest_, bridge_), /*is_marked=*/true, known);
}

}  // namespace etude
