#pragma once

#include <span>

#include "engine/kinematics/solvers/batch_sweep.h"
#include "engine/kinematics/solvers/sweep_tree.h"
#include "engine/kinematics/weights.h"

namespace etude {

/// When a lane reports.
struct LaneRules {
  WeightFormula formula;
  double position_goal = 0;  ///< metres
  double axis_goal = 0;      ///< radians
  double stall_change = 0;   ///< radians
  int max_sweeps = 0;
  bool reports_every_sweep = false;
};

/// Where lanes get their problems from, and whom they report to.
class LaneQueue {
 public:
  virtual ~LaneQueue() = default;

  /// The number of the next problem to take; −1 when there is none.
  virtual int Next() = 0;
  virtual const SweepProblem& Numbers(int problem) const = 0;

  /// `problem` may have met its goals, has stalled or has come to its last sweep: it stands at these angles, `sweeps`
  /// sweeps after its last report or its start. Whether it shall be swept on; if not, it is done.
  virtual bool Report(int problem, int sweeps, bool has_stalled, std::span<const double> cosines,
                      std::span<const double> sines) = 0;
};

/// Sweeps problems until the queue is empty, each in a lane of its own.
void SweepLanes(const SweepTree& tree, int dof_count, const LaneRules& rules, Precision precision, LaneQueue& queue);

}  // namespace etude
