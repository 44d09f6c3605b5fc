#pragma once

#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// What one method did in one world.
struct TransitionOutcome {
  TransitionRequest request;
  bool matched = false;  ///< it chose the frames left and entered because they are alike
  MatchRules rules;      ///< those that its distances go by
  TransitionRecord record;
  Splice splice;  ///< empty when the record found no way
};

/// The frames of a splice from so long before its first seam to so long after its last, as far as the motion goes.
FrameWindow AroundPoints(const Splice& splice, double seconds);

/// The meeting of a switch with legs that the fuzzy distance thinks worst.
const FuzzyDistance& WorstDistance(const TransitionRecord& record);

}  // namespace etude
