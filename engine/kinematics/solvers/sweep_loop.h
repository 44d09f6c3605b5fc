#pragma once

#include "engine/kinematics/solvers/ik_run.h"

namespace etude {

/// What solvers do that go sweep by sweep and do not look at errors themselves: `step(run)` makes one iteration of
/// `sweep`, which stands at the problem's start, and returns the largest turn. `sweep` tells with `MissesGoals` whether
/// its pose certainly misses them; where it may meet them, and where somebody looks, the errors are those of `Angles`.
template <class Sweep, class Step>
IkSolution RunSweeps(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, const Sweep& sweep,
                     Step step) {
  IkRun run(tree, problem, options);
  TreeState state = problem.start;
  state.angles = run.start_angles();
  TreeFrames frames = ComputeFrames(tree, state);
  run.NoteFrames(frames, state.angles);
  while (run.MustGoOn()) {
    const bool has_stalled = step(run) < options.stall_change;
    const bool is_last = has_stalled || run.iterations() + 1 == options.max_iterations;
    if (run.Traces() || is_last || !sweep.MissesGoals()) {
      state.angles = sweep.Angles();
      ComputeFrames(tree, state, frames);
      run.NoteFrames(frames, state.angles);
    } else {
      run.NoteMisses();
    }
    if (has_stalled) run.Stall();
  }
  return run.Finish(std::move(state.angles));
}

}  // namespace etude
