#pragma once

#include "bench/metrics/matching.h"
#include "bench/tasks/transition/stage.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// What the rules of a fuzzy choice make of all pairs of frames that it may take.
MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const TransitionWay& way);

}  // namespace etude
