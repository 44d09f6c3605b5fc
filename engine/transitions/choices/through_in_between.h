#pragma once

#include <cstdint>
#include <string>

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// Plans a transition through an in-between, for requests without a matching pair of frames (paper A, section 3.5). The
/// playing clip is left at the first bridge frame within the budget that matches a key pose of the in-betweens. The
/// wanted clip is entered at the first bridge frame that matches a key pose; its front half is searched first. If a
/// frame matches several keys, the nearest key is taken. If no frame of a clip matches, the clip's frame nearest to any
/// key is taken; the transition is then forced, and its distance may exceed the threshold.
///
/// The transition takes at most the budget plus LongestInBetween. It always exists unless the library has no keys; the
/// record then has no segments. The clip `request.to` must have at least two frames. `why_not` states why there is no
/// direct transition; `pairs_seen` is the number of pairs that were compared before.
TransitionRecord ThroughInBetween(const MotionLibrary& library, const TransitionRequest& request,
                                  const MatchRules& rules, const std::string& why_not, std::int64_t pairs_seen);

}  // namespace etude
