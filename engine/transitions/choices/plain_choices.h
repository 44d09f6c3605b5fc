#pragma once

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// Plans a transition at once into the wanted clip's first frame, whatever the poses.
TransitionRecord PlanNow(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules);

/// Plans a transition from the playing clip's last frame into the wanted clip's first, whatever the budget, as a player
/// without bridging does (paper A, section 1).
TransitionRecord PlanWaitForEnd(const MotionLibrary& library, const TransitionRequest& request,
                                const MatchRules& rules);

/// Plans nature's yardstick, which does not answer the request: the playing clip goes on as if nothing had been asked.
/// The record has one transition point all the same, of the request's frame with itself: every measure then tells what
/// it makes of motion that was never cut, on the very frames where the others change clips. Any join leaves the clip as
/// it is.
///
/// No segments when the request comes at the clip's last frame, after which there is nothing to go on with.
TransitionRecord PlanUnbroken(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules);

/// Returns the library's body at rest over the origin, facing +Z: limbs straight, arms hanging, soles on the floor.
BodyPose StandingPose(const BodyProportions& proportions);

/// Plans what paper A says games do (section 1: all their clips begin and end standing): leave at once, tween into a
/// standing pose, and tween from there into the wanted clip's first frame. It ignores the budget: the tweens take as
/// long as their rules say.
TransitionRecord PlanThroughStanding(const MotionLibrary& library, const TransitionRequest& request,
                                     const MatchRules& rules);

}  // namespace etude
