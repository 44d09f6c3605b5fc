#include "engine/kinematics/solvers/damped_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "engine/kinematics/body_tree.h"
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
    const IkSolution solution = SolveDampedLeastSquares(tree, problem, options, {.first_damping = 0.1});

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

// A hinge of lever r, δ short of its target: with a = (r / 30 cm)², a step is a sin δ / (a + λ).
TEST(DampedLeastSquares, TurnsAHingeByDampedStepsOfBoundedLength) {
  const KinematicTree arm = Arm({0.5}, 1);
  const double a = (0.5 / kPositionScale) * (0.5 / kPositionScale);
  const auto angle_after = [&](double target, double first_damping, int steps) {
    IkOptions options;
    options.max_iterations = steps;
    const IkProblem problem = Reach(arm, {0}, {0, -0.5 * std::sin(target), 1 + 0.5 * std::cos(target)});
    return SolveDampedLeastSquares(arm, problem, options, {.first_damping = first_damping}).angles[0];
  };
  const double first = a * std::sin(0.5) / (a + 2);
  EXPECT_NEAR(angle_after(0.5, 2, 1), first, 1e-12);
  EXPECT_NEAR(angle_after(0.5, 2, 2), first + a * std::sin(0.5 - first) / (a + 2.0 / 5), 1e-12)
      << "a step that lowers the sum makes the next one bolder";
  EXPECT_NEAR(angle_after(1.5, 1e-6, 1), kLargestTurn, 1e-12);
}

TEST(DampedLeastSquares, StallsOnlyOnceAStepGainsNextToNothing) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 0.5), 3, 30);
  IkOptions options;
  options.angle_change_tolerance = Radians(4);  // nothing that meets the targets is so near
  options.trace = true;
  const IkSolution solution = SolveDampedLeastSquares(tree, problem, options);
  EXPECT_EQ(solution.status, IkStatus::kStalled);
  const LinearTargets linear(tree, problem.targets);
  std::vector<double> gains;  // of each step that was taken, as parts of the sum
  double before = 0;
  for (const IkTraceEntry& entry : solution.trace) {
    TreeState state = problem.start;
    state.angles = entry.angles;
    const double cost = linear.Cost(ComputeFrames(tree, state));
    if (cost < before) gains.push_back((before - cost) / before);
    before = cost;
  }
  ASSERT_GT(gains.size(), 2u);
  EXPECT_LT(gains.back(), 1e-6);
  for (std::size_t i = 0; i + 1 < gains.size(); ++i) EXPECT_GE(gains[i], 1e-6) << i;
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

TEST(DampedLeastSquares, NeverRaisesTheSumNorLeavesItsLimitsByAnActiveSetEither) {
  const KinematicTree tree = MakeBodyTree({});
  int at_ends = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 30);
    IkOptions options;
    options.trace = true;
    const LinearTargets linear(tree, problem.targets);
    double before = 1e300;
    for (const IkTraceEntry& entry :
         SolveDampedLeastSquares(tree, problem, options, {.bounds = Bounds::kActiveSet}).trace) {
      TreeState state = problem.start;
      state.angles = entry.angles;
      const double cost = linear.Cost(ComputeFrames(tree, state));
      EXPECT_LE(cost, before);
      before = cost;
      for (int i = 0; i < 29; ++i) {
        EXPECT_TRUE(entry.angles[i] >= problem.limits[i].lower && entry.angles[i] <= problem.limits[i].upper);
        at_ends += entry.angles[i] == problem.limits[i].lower || entry.angles[i] == problem.limits[i].upper;
      }
    }
  }
  EXPECT_GT(at_ends, 100) << "else no bound was put to the test";
}

// Where limits bind nothing the two are one method, but for how long steps are shortened.
TEST(DampedLeastSquares, StepsAlikeWithAndWithoutAnActiveSetFarFromTheLimits) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.5), trial, 3);
    IkOptions options;
    options.limits = false;
    const IkSolution clamped = SolveDampedLeastSquares(tree, problem, options);
    const IkSolution active = SolveDampedLeastSquares(tree, problem, options, {.bounds = Bounds::kActiveSet});
    EXPECT_EQ(active.iterations, clamped.iterations);
    for (int i = 0; i < 29; ++i) EXPECT_NEAR(active.angles[i], clamped.angles[i], 1e-9);
  }
}

}  // namespace
}  // namespace etude
