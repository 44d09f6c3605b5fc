#include "engine/kinematics/solvers/damped_least_squares.h"

#include <algorithm>

#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

constexpr double kSmallestDamping = 1e-9;
constexpr double kLargestDamping = 1e6;
constexpr double kDampingStep = 5;
// A step that lowers the sum by a smaller part than this would have to be taken a million times to matter.
constexpr double kSmallestGain = 1e-6;

}  // namespace

IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const DampedLeastSquaresOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    DampedInverse inverse;
    const std::vector<double> none_preferred(state.angles.size(), 0.0);
    std::vector<double> step;
    linear.Build(frames);
    inverse.Build(linear);
    double cost = linear.Cost(frames);
    double damping = own.first_damping;
    TreeState trial = state;
    TreeFrames trial_frames = frames;
    while (run.MustGoOn()) {
      if (own.bounds == Bounds::kClamped) {
        while (!inverse.Step(damping, none_preferred, step)) damping *= kDampingStep;
        for (double& turn : step) turn = std::clamp(turn, -kLargestTurn, kLargestTurn);
      } else {
        while (!inverse.StepWithin(damping, none_preferred, state.angles, run.ranges(), step)) damping *= kDampingStep;
        Shorten(step);
      }
      const double largest = MoveWithin(run.ranges(), state.angles, step, trial.angles);
      ComputeFrames(tree, trial, trial_frames);
      const double trial_cost = linear.Cost(trial_frames);
      if (largest < options.stall_change || damping > kLargestDamping) run.Stall();
      if (trial_cost < cost) {
        if (cost - trial_cost < kSmallestGain * cost) run.Stall();
        std::swap(state, trial);
        std::swap(frames, trial_frames);
        cost = trial_cost;
        damping = std::max(damping / kDampingStep, kSmallestDamping);
        linear.Build(frames);
        inverse.Build(linear);
      } else {
        damping *= kDampingStep;
      }
      run.RecordFrames(frames, state.angles);
    }
  });
}

}  // namespace etude
