#pragma once

#include <string>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/options.h"
#include "bench/tasks/transition/stage.h"

namespace etude {

/// What one method did in one world.
struct SwitchOutcome {
  const TransitionMethod* method = nullptr;
  FeatureWeights weights{};  ///< those it went by
  Transition plan;
  Splice splice;  ///< empty when the plan found no way
};

/// The metrics of a switch (metrics.md), the worst seam counting where an in-between made two.
void ScoreSwitch(const SwitchOutcome& outcome, const Stage& stage, CellResult& result);

/// Every metric missing, for one reason.
void MissAllMetrics(const std::string& reason, CellResult& result);

/// The curve of largest second differences from one second before the first seam to one second after the last.
Series SeamSeries(const SwitchOutcome& outcome);

/// The switch with 2.5 s before and after it: track "coach", and the facts a video captions.
Recording RecordSwitch(const SwitchOutcome& outcome, const Stage& stage);

}  // namespace etude
