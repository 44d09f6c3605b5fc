#pragma once

#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// The state after one iteration, as a film shows it.
struct IkRecordedStep {
  int iteration = 0;
  std::vector<double> angles;
  double position_error_max_cm = 0;
  double orientation_error_max_deg = 0;
  double axis_error_max_deg = 0;  ///< of the worst single axis, which "solved" is judged by
};

/// Which of the iterations 0…`last` a recording shows: every one up to 60, then growing steps up to the last; at most
/// 150.
std::vector<int> RecordedIterations(int last);

/// The steps of a trace at the recorded iterations.
std::vector<IkRecordedStep> StepsOf(std::span<const IkTraceEntry> trace);

/// Tracks "truth", "start" and, step by step, "solution"; the extras tell which iteration every frame shows, its
/// errors, and where the end effectors' targets are, in the tree's order (null where no position is asked for):
///
///     {"iterations": [0, 1, …], "position_error_max_cm": [41.3, …], "orientation_error_max_deg": [37.9, …],
///      "axis_error_max_deg": [41.0, …], "targets_m": [[0.1, 0.05, 0.2], …]}
Recording RecordIk(const KinematicTree& tree, const IkWorld& world, std::span<const IkRecordedStep> steps);

}  // namespace etude
