#include "engine/kinematics/solvers/jacobian_pinv.h"

#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {

IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  TreeState state = problem.start;
  state.angles = run.start_angles();
  TreeFrames frames = ComputeFrames(tree, state);
  run.NoteFrames(frames, state.angles);

  LinearTargets linear(tree, problem.targets);
  DampedInverse inverse;
  std::vector<double> wish(state.angles.size()), step;
  while (run.MustGoOn()) {
    linear.Build(frames);
    inverse.Build(linear);
    for (std::size_t i = 0; i < wish.size(); ++i) wish[i] = run.start_angles()[i] - state.angles[i];
    if (!inverse.Step(options.tuning.pinv_damping, wish, step)) {
      run.Stall();
      break;
    }
    Shorten(step);
    if (MoveWithin(run.ranges(), state.angles, step, state.angles) < options.stall_change) run.Stall();
    ComputeFrames(tree, state, frames);
    run.NoteFrames(frames, state.angles);
  }
  return run.Finish(std::move(state.angles));
}

}  // namespace etude
