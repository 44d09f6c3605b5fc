#include "engine/kinematics/solvers/jacobian_pinv.h"

#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {

IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                             const JacobianPinvOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    DampedInverse inverse;
    std::vector<double> to_preferred(state.angles.size()), step;
    while (run.MustGoOn()) {
      linear.Build(frames);
      inverse.Build(linear);
      for (std::size_t i = 0; i < to_preferred.size(); ++i) to_preferred[i] = run.start_angles()[i] - state.angles[i];
      if (!inverse.Step(own.damping, to_preferred, step)) return run.Stall();
      Shorten(step);
      if (MoveWithin(run.ranges(), state.angles, step, state.angles) < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

}  // namespace etude
