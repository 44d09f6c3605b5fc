#pragma once

#include <cstdint>
#include <string>

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// Plans a transition through an in-between, for when no pair of frames matches (paper A, section 3.5): out of the
/// playing clip at the first bridge frame within the budget that a key of an in-between matches, and into the wanted
/// clip at the first bridge frame that a key matches, front half first; of several keys the nearest. Where none matches
/// at either end, the frame that is nearest to a key is taken there: that way is forced, and its distance may not be
/// below the threshold.
///
/// There always is a way, of at most the budget and LongestInBetween; no segments only when the library has no keys.
/// `request.to` must have two frames. `why_not` says why there is no direct way; `pairs_seen` were compared to know
/// that.
TransitionRecord ThroughInBetween(const MotionLibrary& library, const TransitionRequest& request,
                                  const MatchRules& rules, const std::string& why_not, std::int64_t pairs_seen);

}  // namespace etude
