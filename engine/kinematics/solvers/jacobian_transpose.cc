#include "engine/kinematics/solvers/jacobian_transpose.h"

#include <Eigen/Dense>

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

}  // namespace etude
