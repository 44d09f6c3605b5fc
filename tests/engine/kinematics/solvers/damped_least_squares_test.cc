#include "engine/kinematics/solvers/damped_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "engine/kinematics/solvers/linear_targets.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

TEST(DampedLeastSquares, FindsTheAnglesOfTwoHingesByTheLawOfCosines) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.7, 1.2);
  const IkSolution solution = SolveDampedLeastSquares(arm, Reach(arm, {0.4, 1.5}, place), Exactly());
  EXPECT_EQ(solution.status, IkStatus::kConverged);
  EXPECT_NEAR(solution.angles[0], 0.7, 1e-8);
  EXPECT_NEAR(solution.angles[1], ElbowAngle(0.5, 0.4, glm::distance(place, {0, 0, 1})), 1e-8);
}

TEST(DampedLeastSquares, ItsFirstStepSolvesTheNormalEquations) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 10; ++trial) {
    IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.5), trial, 3);
    problem.targets[1].axis_weights = {0, 0, 2};
    problem.targets[2].position_weight = 0;
    IkOptions options;
    options.limits = false;
    options.max_iterations = 1;
    options.tuning.first_damping = 0.1;
    const IkSolution solution = SolveDampedLeastSquares(tree, problem, options);

    // The other way round: (JᵀJ + λI) Δq = Jᵀe, of 29 unknowns.
    LinearTargets linear(tree, problem.targets);
    linear.Build(ComputeFrames(tree, problem.start));
    const Eigen::Map<const Eigen::MatrixXd> jacobian(linear.jacobian().data(), linear.rows(), linear.columns());
    const Eigen::Map<const Eigen::VectorXd> residuals(linear.residuals().data(), linear.rows());
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian + 0.1 * Eigen::MatrixXd::Identity(29, 29);
    const Eigen::VectorXd step = normal.ldlt().solve(jacobian.transpose() * residuals);
    ASSERT_LT(step.cwiseAbs().maxCoeff(), 0.6) << "else it is shortened";
    for (int i = 0; i < 29; ++i) EXPECT_NEAR(solution.angles[i] - problem.start.angles[i], step[i], 1e-12);
  }
}

TEST(DampedLeastSquares, NeverRaisesTheSumOfSquares) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 30);
    IkOptions options;
    options.trace = true;
    const LinearTargets linear(tree, problem.targets);
    double before = 1e300;
    for (const IkTraceEntry& entry : SolveDampedLeastSquares(tree, problem, options).trace) {
      TreeState state = problem.start;
      state.angles = entry.angles;
      const double cost = linear.Cost(ComputeFrames(tree, state));
      EXPECT_LE(cost, before);
      before = cost;
    }
  }
}

}  // namespace
}  // namespace etude
