#pragma once

#include "bench/metrics/matching.h"
#include "bench/tasks/transition/stage.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// What the rules of a fuzzy choice make of the pairs of frames that it may take: those of AllowedPairs, or, of a
/// choice that goes by bridge frames, a bridge frame of the playing clip within the budget and one of the wanted clip
/// but its last, after which nothing would follow.
MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const Choice& choice,
                        const MatchRules& rules);

}  // namespace etude
