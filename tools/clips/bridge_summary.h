#pragma once

#include <string>

#include "engine/transitions/library/transition_points.h"
#include "io/files/json.h"
#include "tools/clips/bridge_library.h"

namespace etude {

/// Writes candidates, reachability and the ways into the corrective clips, for people at a terminal. A matrix wider
/// than 24 clips is left to the JSON.
std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

/// Gives the same for programs (docs/schemas/bridge-summary.schema.json). Shares of a clip are means over the
/// other clips; a clip that leads nowhere has no worst wait.
Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

}  // namespace etude
