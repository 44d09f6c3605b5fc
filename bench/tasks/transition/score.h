#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"

namespace etude {

/// The metrics of a transition that has a way (docs/metrics.md), the worst transition point counting where an
/// in-between made two.
void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result);

/// The metrics of the pairs that a transition could have used; nothing for a method without a threshold.
void ScoreMatching(const std::optional<MatchTally>& tally, CellResult& result);

/// The ids of all of them, in the order in which they are measured.
std::vector<std::string> TransitionMetrics();

/// What a method without a transition is credited with (Task::ValueOfFailure): 0 of `natural_share` and the other
/// shares of all cells. A transition that never came was not natural; left out of the count, a method could raise its
/// share by giving up where it is hard. Nothing for the rest: no number of centimetres stands for a jump that was not
/// made, and 0 of `false_smooth` would be praise.
std::optional<double> TransitionFailureValue(std::string_view metric);

/// Those of ScoreTransition in a world in which no way was found.
void MeasureNoWay(CellResult& result);

}  // namespace etude
