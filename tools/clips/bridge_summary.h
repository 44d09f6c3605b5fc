#pragma once

#include <string>

#include "engine/transitions/library/coverage.h"
#include "io/files/json.h"
#include "tools/clips/bridge_library.h"

namespace etude {

/// For more clips than this, the table of pairs is left out unless it is requested, because the size of this table
/// grows with the square of the number of clips.
constexpr int kMaxClipsWithPairs = 300;

/// Writes the number of bridge frames, the reachability, and the ways into the corrective clips, as text for a
/// terminal. With pairs, a clip's figures are means over the other clips; without pairs, the figures are for all other
/// clips together. For more than 24 clips, only the JSON has the table of pairs. `wait_s` is the maximum wait before a
/// transition, seconds, with which `coverage` was computed.
std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

/// Writes the content of BridgeSummaryAsText for programs (docs/schemas/bridge-summary.schema.json). Without pairs,
/// figures that need the pairs are null, and the member `pairs` is missing.
Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

}  // namespace etude
