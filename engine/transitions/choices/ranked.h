#pragma once

#include <string>

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/choices/allowed_frames.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {

/// Which pairs are ranked, and by what.
struct Ranking {
  AllowedFrames allowed;
  std::string name;    ///< "point-cloud distance"
  std::string unit;    ///< "cm"
  bool gated = false;  ///< only pairs that match by the rules; where none does, through an in-between
};

/// Takes, of all allowed pairs, the one of least cost, the earlier one on a tie.
TransitionRecord PlanRanked(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const Ranking& ranking, PairRows& costs);

}  // namespace etude
