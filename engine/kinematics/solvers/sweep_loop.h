#pragma once

#include "engine/kinematics/solvers/ik_run.h"

namespace etude {

/// What solvers do that go sweep by sweep and do not look at errors themselves: `step(sweep, run)` makes one iteration
/// of a Sweep, made of (tree, problem, options, own…), and returns the largest turn. The sweep tells with `MissesGoals`
/// whether its pose certainly misses them; where it may meet them, and in a trace, errors are measured at
/// `Angles`.
template <class Sweep, class Step, class... Own>
IkSolution RunSweeps(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, const Step& step,
                     const Own&... own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Sweep sweep(tree, problem, options, own...);
    while (run.MustGoOn()) {
      const bool has_stalled = step(sweep, run) < options.stall_change;
      const bool is_last = has_stalled || run.iterations() + 1 == options.max_iterations;
      if (run.Traces() || is_last || !sweep.MissesGoals()) {
        state.angles = sweep.Angles();
        ComputeFrames(tree, state, frames);
        run.RecordFrames(frames, state.angles);
      } else {
        run.RecordMisses();
      }
      if (has_stalled) run.Stall();
    }
  });
}

}  // namespace etude
