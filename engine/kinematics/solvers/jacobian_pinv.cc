#include "engine/kinematics/solvers/jacobian_pinv.h"

#include <algorithm>

#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

// Of the active set's steps where an undamped one within the limits cannot meet the targets.
constexpr double kFallbackDamping = 0.1;

}  // namespace

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
      const auto step_within = [&](double damping) {
        return inverse.StepWithin(damping, to_preferred, state.angles, run.ranges(), step);
      };
      bool has_step = false;
      if (own.bounds == Bounds::kClamped) {
        has_step = inverse.Step(own.damping, to_preferred, step);
      } else {
        has_step =
            (step_within(own.damping) && inverse.is_exact()) || step_within(std::max(own.damping, kFallbackDamping));
      }
      if (!has_step) return run.Stall();
      Shorten(step);
      if (MoveWithin(run.ranges(), state.angles, step, state.angles) < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

}  // namespace etude
