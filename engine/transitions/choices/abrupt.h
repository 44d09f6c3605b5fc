#pragma once

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// At once, into the wanted clip's first frame, whatever the poses.
TransitionRecord PlanNow(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules);

/// After the playing clip's last frame, into the wanted clip's first, whatever the budget: what a player without
/// bridging does (paper A, section 1).
TransitionRecord PlanWaitForEnd(const MotionLibrary& library, const TransitionRequest& request,
                                const MatchRules& rules);

}  // namespace etude
