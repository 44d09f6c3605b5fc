#pragma once

#include <string>

#include "engine/transitions/library/transition_points.h"
#include "io/files/json.h"
#include "tools/clips/bridge_library.h"

namespace etude {

/// Writes the number of bridge frames, the reachability, and the ways into the corrective clips, as text for a
/// terminal. For more than 24 clips the matrix is only in the JSON.
std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

/// Writes the same for programs (docs/schemas/bridge-summary.schema.json). A clip's shares are means over the other
/// clips; a clip that leads nowhere has no worst wait.
Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

}  // namespace etude
