#pragma once

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// What is remembered between frames to see a clap.
struct ClapState {
  int since_apart = kLongAgo;  ///< frames since the hands were last apart
  int together = 0;            ///< frames in a row for which they have been together
  static constexpr int kLongAgo = 1000;
};

/// Takes one frame in; true in the frame in which a clap is seen: both hands, in sight and above the hips, have met
/// within half a second of being apart. At 30 Hz.
bool SeeClap(const SensedFrame& frame, ClapState& state);

}  // namespace etude
