#pragma once

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A record of two segments: the playing clip up to `leave_frame`, the wanted one after `enter_frame`. The branch is by
/// half (paper A, section 3.5), the distance by the rules' weights; why is left to the caller.
TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules);

}  // namespace etude
