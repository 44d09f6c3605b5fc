#pragma once

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// Nature's yardstick, no answer to the request: the playing clip goes on as if nothing had been asked. The record has
/// one transition point all the same, of the request's frame with itself: every measure then tells what it makes of
/// motion that was never cut, on the very frames where the others change clips. Any join leaves the clip as it is.
///
/// No segments when the request comes at the clip's last frame, after which there is nothing to go on with.
TransitionRecord PlanUnbroken(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules);

}  // namespace etude
