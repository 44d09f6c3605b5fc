#pragma once

#include <string>
#include <vector>

#include "bench/files/json.h"
#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {

/// The clips of `etude bridge`, performed by one body and tagged.
struct BridgeLibrary {
  FuzzySystem system;
  TagRules tag_rules;
  MatchRules match_rules;
  MotionLibrary library;
  std::vector<std::string> sources;  ///< what opens the clips again
  std::vector<int> corrective;       ///< the clips that every other one must lead into
};

/// Writes candidates, reachability and the ways into the corrective clips, for people at a terminal. A matrix wider
/// than 24 clips is left to the JSON.
std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

/// Gives the same for programs (docs/schemas/bridge-summary.schema.json). Shares of a clip are means over the
/// other clips; a clip that leads nowhere has no worst wait.
Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

}  // namespace etude
