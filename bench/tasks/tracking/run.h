#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/tracking/options.h"
#include "bench/tasks/tracking/world.h"

namespace etude {

/// A motion as a method followed it, one entry per frame.
struct TrackingAnswer {
  std::vector<std::vector<double>> angles;  ///< radians
  std::optional<std::vector<int>> iterations;
};

/// Lets a solver follow the motion: every frame within the method's budget, from where its `start` says. A frame that
/// it did not solve is left as it is, and a warm one goes on from there. Fails, naming the frame, when the solver finds
/// fault with a problem.
Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method);

/// Measures an answer against the targets that it was given and the motion that is true, whoever gave it: one entry
/// per frame in all. `ok` when every frame is solved practically, else `unsolved` with how many are not and the first
/// of them; a broken limit makes its frame unsolved. Series along the frames; `keeps_motion`: a recording with the
/// tracks "truth" and "solution".
CellResult ScoreTracking(const TrackingWorld& world, double rate_hz, const TrackingAnswer& answer, bool keeps_motion);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> TrackingMetrics();

/// The value of a metric for a cell without an answer: 0 for shares of frames.
std::optional<double> TrackingValueOfFailure(std::string_view metric);

}  // namespace etude
