#pragma once

#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// What one method did in one world.
struct SwitchOutcome {
  SwitchRequest request;
  bool matched = false;  ///< it chose the frames left and entered because they are alike
  SwitchRules rules;     ///< those that its distances go by
  SwitchRecord record;
  Splice splice;  ///< empty when the record found no way
};

/// The frames of a splice from so long before its first seam to so long after its last, as far as the motion goes.
FrameWindow AroundSeams(const Splice& splice, double seconds);

/// The meeting of a switch with legs that the fuzzy distance thinks worst.
const FuzzyDistance& WorstMeeting(const SwitchRecord& record);

}  // namespace etude
