#pragma once

#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/tracking/run.h"
#include "bench/tasks/tracking/world.h"

namespace etude {

/// Measures an answer against the targets that it was given and the motion that is true, whoever gave it: one entry
/// per frame in all. `ok` when every frame is solved practically, else `unsolved` with how many are not and the first
/// of them; a broken limit makes its frame unsolved. Series along the frames; `keeps_motion`: a recording with the
/// tracks "truth" and "solution".
CellResult ScoreTracking(const TrackingWorld& world, double rate_hz, const TrackingAnswer& answer, bool keeps_motion);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> TrackingMetrics();

/// What a cell without an answer is credited with: 0 for shares of frames.
std::optional<double> TrackingValueOfFailure(std::string_view metric);

}  // namespace etude
