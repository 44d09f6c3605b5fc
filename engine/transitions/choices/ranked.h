#pragma once

#include <string>

#include "engine/transitions/choices/pair_rows.h"

namespace etude {

/// What pairs are ranked by.
struct Ranking {
  std::string name;    ///< "point-cloud distance"
  std::string unit;    ///< "cm"
  bool gated = false;  ///< only pairs that match by the rules; where none does, through an in-between
};

/// Takes, of all pairs of AllowedPairs, the one of least cost, the earlier one on a tie.
SwitchRecord PlanRanked(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules,
                        const Ranking& ranking, PairRows& costs);

}  // namespace etude
