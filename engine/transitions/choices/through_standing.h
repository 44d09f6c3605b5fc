#pragma once

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// The library's body at rest over the origin, facing +Z: limbs straight, arms hanging, soles on the floor.
BodyPose StandingPose(const BodyProportions& proportions);

/// What paper A says games do (section 1: all their clips begin and end standing): leave at once, tween into a standing
/// pose, tween from there into the wanted clip's first frame. Whatever the budget: the tweens take as long as their
/// rules say.
TransitionRecord PlanThroughStanding(const MotionLibrary& library, const TransitionRequest& request,
                                     const MatchRules& rules);

}  // namespace etude
