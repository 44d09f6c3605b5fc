#pragma once

#include <string>

#include "engine/transitions/library/coverage.h"
#include "io/files/json.h"
#include "tools/clips/bridge_library.h"

namespace etude {

/// A library of more clips has no table of pairs unless it is asked for: its size grows with the square of the library.
constexpr int kMaxClipsWithPairs = 300;

/// Writes the number of bridge frames, the reachability, and the ways into the corrective clips, as text for a
/// terminal. With pairs, a clip's figures are means over the other clips; without, they are for all other clips
/// together. For more than 24 clips the matrix is only in the JSON.
std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

/// Writes the same for programs (docs/schemas/bridge-summary.schema.json). Figures that need pairs are null without
/// them, and `pairs` is missing.
Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s);

}  // namespace etude
