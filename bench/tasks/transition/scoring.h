#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/stage.h"
#include "engine/switching/joins/splice.h"

namespace etude {

/// What one method did in one world.
struct SwitchOutcome {
  bool matched = false;      ///< it chose the frames left and entered because they are alike
  FeatureWeights weights{};  ///< those that its distances go by
  SwitchRecord record;
  Splice splice;  ///< empty when the record found no way
};

/// The metrics of a switch (docs/metrics.md), the worst seam counting where an in-between made two.
void ScoreSwitch(const SwitchOutcome& outcome, const Stage& stage, CellResult& result);

/// The ids of all of them, in the order in which they are measured.
std::vector<std::string> TransitionMetrics();

/// What a method without a switch is credited with (Task::ValueOfFailure): 0 of `natural_share`, which is a share of
/// all cells. A switch that never came was not natural; left out of the count, a method could raise its share by
/// giving up where it is hard. Nothing for the rest: no number of centimetres stands for a jump that was not made,
/// and 0 of `false_smooth` would be praise.
std::optional<double> SwitchFailureValue(std::string_view metric);

/// The metrics of a world in which no way was found.
void MeasureNoWay(CellResult& result);

/// The curve of largest second differences from one second before the first seam to one second after the last.
Series SeamSeries(const SwitchOutcome& outcome);

/// The switch with 2.5 s before and after it: track "coach", and the facts a video captions.
Recording RecordSwitch(const SwitchOutcome& outcome, const Stage& stage);

}  // namespace etude
