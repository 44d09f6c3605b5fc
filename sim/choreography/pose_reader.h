#pragma once

#include <vector>

#include "engine/base/result.h"
#include "engine/document/node.h"
#include "sim/choreography/move.h"
#include "sim/choreography/move_curves.h"

namespace etude {

/// Reads the list `poses` of a choreography file. Each pose says how the body differs from the ready
/// stance (controls.h names the groups; "arms", "legs", … set both sides), at a `beat` within
/// [0, beats); `hold_beats` keeps it, `ease` says how it is reached. Beats must ascend. At most 256 poses.
Result<std::vector<PoseKey>> ReadPoses(const Node& poses, double beats);

/// Reads the list `key_poses`: `{beat, tolerance_deg, <feature>: degrees, …}`, where a feature may have
/// its own tolerance: `RH: {degrees: 90, tolerance_deg: 10}`.
Result<std::vector<KeyPose>> ReadKeyPoses(const Node& key_poses, double beats);

}  // namespace etude
