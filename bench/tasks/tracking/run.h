#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/tracking/options.h"
#include "bench/tasks/tracking/world.h"

namespace etude {

/// A method's answer for a motion, one entry per frame.
struct TrackingAnswer {
  std::vector<std::vector<double>> angles;  ///< indexed [frame][angle], radians
  std::optional<std::vector<int>> iterations;
};

/// Lets a solver follow the motion. It solves every frame within the method's budget, from the start that
/// `method.start` chooses. An unsolved frame keeps the solver's last angles, and a warm start continues from them.
/// Fails, naming the frame, if a problem is invalid for the solver.
Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method);

/// Measures an answer against the given targets and the true motion. The answer has one entry per frame. A frame is
/// unsolved (IsFrameSolved) if it misses its targets or exceeds a joint limit. The cell is `ok` if every frame is
/// solved, else `unsolved`. The reason then describes the first frame that exceeds a joint limit. If there is none,
/// the reason states the number of unsolved frames and the first of them. The cell's series have one value per frame.
/// With `keeps_motion`, a recording has the tracks "truth" and "solution".
CellResult ScoreTracking(const TrackingWorld& world, double rate_hz, const TrackingAnswer& answer, bool keeps_motion);

/// Returns the ids of all metrics that a cell reports, by a value or by the reason why the value is missing.
std::vector<std::string> TrackingMetrics();

/// Returns the value of a metric for a cell without an answer: 0 for shares of frames. Returns nothing for other
/// metrics.
std::optional<double> TrackingValueOfFailure(std::string_view metric);

}  // namespace etude
