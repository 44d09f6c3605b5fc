#pragma once

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// Paper A's transition (section 3.5): at each bridge frame of the playing clip within the budget, the first (or, by
/// `rules.pick`, the nearest) bridge frame of the wanted clip, front half before rear half; else through an in-between.
TransitionRecord PlanFuzzyBridge(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules);

}  // namespace etude
