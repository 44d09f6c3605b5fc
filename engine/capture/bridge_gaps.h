#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/capture/measure_frames.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {

struct BridgeOptions {
  /// How many frames a measurement is used before and after its own. 15 is half a second at 30 Hz, after which a
  /// performer's limb may be anywhere. Scale it with the rate; when only every n-th frame is marked, make it n at
  /// least.
  int longest_gap = 15;
};

/// Completes every frame from the nearest measured ones before and after it, each quantity by itself (ours): directions
/// along the great circle (slerp), points straight; before the first and after the last measured one that one is
/// held. A frame stays empty when something in it was not measured within `longest_gap` frames before or after it.
std::vector<std::optional<LimbObservation>> BridgeGaps(std::span<const FrameMeasurement> frames,
                                                       const BridgeOptions& options = {});

}  // namespace etude
