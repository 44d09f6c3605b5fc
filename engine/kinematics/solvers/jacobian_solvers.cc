#include "engine/kinematics/solvers/jacobian_solvers.h"

#include <Eigen/Dense>
#include <algorithm>

#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

// α JᵀdX at `angles`; zeros when nothing pulls.
void ComputeStep(const LinearTargets& linear, std::span<const double> angles, std::span<const AngleRange> ranges,
                 double gain, Eigen::VectorXd& step) {
  const Eigen::Map<const Eigen::MatrixXd> jacobian(linear.jacobian().data(), linear.rows(), linear.columns());
  const Eigen::Map<const Eigen::VectorXd> residuals(linear.residuals().data(), linear.rows());
  step.noalias() = jacobian.transpose() * residuals;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    double& torque = step[static_cast<Eigen::Index>(i)];
    const bool is_blocked = torque < 0 ? angles[i] <= ranges[i].lower : angles[i] >= ranges[i].upper;
    if (is_blocked) torque = 0;
  }
  const Eigen::VectorXd gained = jacobian * step;
  const double length = gained.squaredNorm();
  if (length > 0) step *= gain * residuals.dot(gained) / length;
}

// Damps the active set's steps where an undamped one within the limits cannot meet the targets.
constexpr double kFallbackDamping = 0.1;

// Damped least squares' range of λ, and the factor by which λ follows the steps' success.
constexpr double kSmallestDamping = 1e-9;
constexpr double kLargestDamping = 1e6;
constexpr double kDampingStep = 5;
// A step that lowers the sum by a smaller part than this would have to be taken a million times to matter.
constexpr double kSmallestGain = 1e-6;

}  // namespace

IkSolution SolveJacobianTranspose(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                  const JacobianTransposeOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    LinearTargets linear(tree, problem.targets);
    Eigen::VectorXd step;
    while (run.MustGoOn()) {
      linear.Build(frames);
      ComputeStep(linear, state.angles, run.ranges(), own.gain, step);
      const std::span<double> turns(step.data(), static_cast<std::size_t>(step.size()));
      Shorten(turns);
      if (MoveWithin(run.ranges(), state.angles, turns, state.angles) < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

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
