#include "engine/kinematics/solvers/jacobian_solvers.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

// Returns the sum of squares after every iteration of a traced solution.
std::vector<double> CostsOf(const IkProblem& problem, const IkSolution& solution) {
  const LinearTargets linear(Body(), problem.targets);
  std::vector<double> costs;
  for (const IkTraceEntry& entry : solution.trace) {
    TreeState state = problem.start;
    state.angles = entry.angles;
    costs.push_back(linear.Cost(ComputeFrames(Body(), state)));
  }
  return costs;
}

TEST(DampedLeastSquares, ItsFirstStepSolvesTheNormalEquations) {
  for (int trial = 0; trial < 10; ++trial) {
    IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 3);
    problem.targets[1].axis_weights = {0, 0, 2};
    problem.targets[2].position_weight = 0;
    IkOptions options{.limits = false, .max_iterations = 1};
    const IkSolution solution = SolveDampedLeastSquares(Body(), problem, options, {.first_damping = 0.1});

    // A second form: (JᵀJ + λI) Δq = Jᵀe with 29 unknowns.
    LinearTargets linear(Body(), problem.targets);
    linear.Build(ComputeFrames(Body(), problem.start));
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
    const IkProblem problem = Reach(arm, {0}, {0, -0.5 * std::sin(target), 1 + 0.5 * std::cos(target)});
    return SolveDampedLeastSquares(arm, problem, {.max_iterations = steps}, {.first_damping = first_damping}).angles[0];
  };
  const double first = a * std::sin(0.5) / (a + 2);
  EXPECT_NEAR(angle_after(0.5, 2, 1), first, 1e-12);
  EXPECT_NEAR(angle_after(0.5, 2, 2), first + a * std::sin(0.5 - first) / (a + 2.0 / 5), 1e-12)
      << "a step that lowers the sum makes the next one bolder";
  EXPECT_NEAR(angle_after(1.5, 1e-6, 1), kMaxTurn, 1e-12);
}

TEST(DampedLeastSquares, StallsOnlyOnceAStepGainsNextToNothing) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 3, 0.5), 3, 30);
  IkOptions options;
  options.angle_change_tolerance = Radians(4);  // no pose within 4° of the start meets the targets
  options.trace = true;
  const IkSolution solution = SolveDampedLeastSquares(Body(), problem, options);
  EXPECT_EQ(solution.status, IkStatus::kStalled);
  std::vector<double> gains;  // relative decrease of the sum in each accepted step
  double before = 0;
  for (const double cost : CostsOf(problem, solution)) {
    if (cost < before) gains.push_back((before - cost) / before);
    before = cost;
  }
  ASSERT_GT(gains.size(), 2u);
  EXPECT_LT(gains.back(), 1e-6);
  for (std::size_t i = 0; i + 1 < gains.size(); ++i) EXPECT_GE(gains[i], 1e-6) << i;
}

TEST(DampedLeastSquares, NeverRaisesTheSumOfSquaresWithOrWithoutAnActiveSet) {
  int at_ends = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 30);
    for (const Bounds bounds : {Bounds::kClamped, Bounds::kActiveSet}) {
      const IkSolution solution = SolveDampedLeastSquares(Body(), problem, {.trace = true}, {.bounds = bounds});
      EXPECT_TRUE(std::ranges::is_sorted(CostsOf(problem, solution), std::greater()));
      for (const IkTraceEntry& entry : solution.trace) {
        for (int i = 0; i < 29; ++i) {
          const AngleRange& range = problem.limits[i];
          at_ends += entry.angles[i] == range.lower || entry.angles[i] == range.upper;
        }
      }
    }
  }
  EXPECT_GT(at_ends, 100) << "else no bound was put to the test";
}

// Far from the limits, both methods differ only in the rule by which they shorten a long step.
TEST(DampedLeastSquares, StepsAlikeWithAndWithoutAnActiveSetFarFromTheLimits) {
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 3);
    IkOptions options{.limits = false};
    const IkSolution clamped = SolveDampedLeastSquares(Body(), problem, options);
    const IkSolution active = SolveDampedLeastSquares(Body(), problem, options, {.bounds = Bounds::kActiveSet});
    EXPECT_EQ(active.iterations, clamped.iterations);
    for (int i = 0; i < 29; ++i) EXPECT_NEAR(active.angles[i], clamped.angles[i], 1e-9);
  }
}

TEST(JacobianPinv, FindsTheAnglesOfAnElbowByTheLawOfCosines) {
  KinematicTree arm = Arm({0.5, 0.4}, 1);
  arm.joints[1].dof_count = 2;  // it also leaves the plane: three angles for three coordinates
  arm.joints[2].first_dof = 2;
  arm.limits.push_back({-kPi, kPi});
  for (const double elbow : {0.4, 1.2, 2.2}) {
    const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.7, elbow);
    const IkSolution solution = SolveJacobianPinv(arm, Reach(arm, {0.5, 0.1, elbow + 0.2}, place), Exactly());
    EXPECT_EQ(solution.status, IkStatus::kConverged);
    EXPECT_NEAR(solution.angles[0], 0.7, 1e-8);
    EXPECT_NEAR(solution.angles[1], 0, 1e-8);
    EXPECT_NEAR(solution.angles[2], ElbowAngle(0.5, 0.4, glm::distance(place, {0, 0, 1})), 1e-8);
  }
}

TEST(JacobianPinv, NeedsDampingWhereLimbsCannotLeaveAPlane) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const IkProblem problem = Reach(arm, {0.5, 1.4}, TwoHingeTip(0.5, 0.4, 0.7, 1.2));
  IkOptions options;
  EXPECT_EQ(SolveJacobianPinv(arm, problem, options).status, IkStatus::kStalled);
  EXPECT_EQ(SolveJacobianPinv(arm, problem, options, {.damping = 1e-6}).status, IkStatus::kConverged);
}

TEST(JacobianPinv, StallsWhereTheInverseDoesNotExist) {
  // Figure 3.8: a stretched limb with its target on its own line.
  const KinematicTree arm = Arm({0.5, 0.4}, 3);
  const IkProblem problem = Reach(arm, std::vector<double>(6, 0.0), {0, 0, 1.5});
  for (const double damping : {0.0, 0.1}) {
    const IkSolution solution = SolveJacobianPinv(arm, problem, {}, {.damping = damping});
    EXPECT_EQ(solution.status, IkStatus::kStalled);
    EXPECT_EQ(solution.angles, problem.start.angles);
    EXPECT_EQ(solution.iterations, damping > 0 ? 1 : 0);
  }
  // The same arm reaches it when slightly bent.
  EXPECT_EQ(SolveJacobianPinv(arm, Reach(arm, {0, 0, 0, 0.3, 0, 0}, {0, 0, 1.5}), {}).status, IkStatus::kConverged);
}

TEST(JacobianPinv, StaysNearerToTheStartThanStepsWithoutAPreferredPosture) {
  IkOptions options{.limits = false};
  double with_posture = 0, without = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 15);
    const auto square = [&](const std::vector<double>& angles) {
      double sum = 0;
      for (std::size_t i = 0; i < angles.size(); ++i) sum += std::pow(angles[i] - problem.start.angles[i], 2);
      return sum;
    };
    const IkSolution solution = SolveJacobianPinv(Body(), problem, options);
    ASSERT_EQ(solution.status, IkStatus::kConverged) << trial;
    with_posture += square(solution.angles);
    // The same steps one by one, each started afresh.
    IkProblem problem_now = problem;
    IkOptions one_step = options;
    one_step.max_iterations = 1;
    for (int i = 0; i < solution.iterations; ++i) {
      problem_now.start.angles = SolveJacobianPinv(Body(), problem_now, one_step).angles;
    }
    without += square(problem_now.start.angles);
  }
  EXPECT_LT(with_posture, without);
}

TEST(JacobianTranspose, OneHingeTurnsByItsTorqueOverTheSquareOfItsLever) {
  const KinematicTree arm = Arm({0.5}, 1);
  const IkProblem problem = Reach(arm, {0.3}, {0, -0.5 * std::sin(0.5), 1 + 0.5 * std::cos(0.5)});
  for (const double gain : {1.0, 0.25}) {
    IkOptions options{.max_iterations = 1};
    // J is a vector of 0.5 m at right angles to the limb. Only the part of dX along J counts: 0.5 m · sin(0.2 rad).
    EXPECT_NEAR(SolveJacobianTranspose(arm, problem, options, {.gain = gain}).angles[0], 0.3 + gain * std::sin(0.2),
                1e-12);
  }
}

TEST(JacobianTranspose, NoStepIsLongerThanFirstOrderIsGoodFor) {
  const KinematicTree arm = Arm({0.5}, 1);
  const IkProblem problem = Reach(arm, {0.3}, {0, -0.5 * std::sin(1.8), 1 + 0.5 * std::cos(1.8)});
  ASSERT_GT(std::sin(1.5), kMaxTurn) << "the step of a gain of 1";
  EXPECT_NEAR(SolveJacobianTranspose(arm, problem, {.max_iterations = 1}).angles[0], 0.3 + kMaxTurn, 1e-12);
}

TEST(JacobianTranspose, EveryStepLowersTheSumOfSquaresNearTheTarget) {
  int steps = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, 3);
    for (const bool limits : {false, true}) {
      IkOptions options{.limits = limits, .max_iterations = 100, .trace = true};
      const std::vector<double> costs = CostsOf(problem, SolveJacobianTranspose(Body(), problem, options));
      for (std::size_t i = 1; i < costs.size(); ++i, ++steps) {
        // A limb that is clamped during a step loses part of the step.
        ASSERT_LT(costs[i], costs[i - 1] * (limits ? 1.05 : 1)) << trial << " step " << i;
      }
    }
  }
  EXPECT_GT(steps, 500);
}

TEST(JacobianTranspose, TooLongStepsRaiseTheSumOfSquares) {
  IkOptions options{.limits = false, .max_iterations = 100, .trace = true};
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 0, 0.5), 0, 3);
  const std::vector<double> costs = CostsOf(problem, SolveJacobianTranspose(Body(), problem, options, {.gain = 2.5}));
  EXPECT_GT(*std::max_element(costs.begin() + 1, costs.end()), costs[0]) << "else monotony proves nothing";
}

TEST(JacobianTranspose, AnAngleThatIsPushedOutOfItsRangeTakesNoPart) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.3, 1.4);
  IkProblem problem = Reach(arm, {0.1, 1.0}, place);
  problem.limits[1] = {0, 1.0};
  const IkSolution held = SolveJacobianTranspose(arm, problem, {.max_iterations = 1});
  EXPECT_EQ(held.angles[1], 1.0);
  // The result is as if the forearm were rigid.
  const glm::dvec3 gap = place - TwoHingeTip(0.5, 0.4, 0.1, 1.0);
  const glm::dvec3 arm_now = TwoHingeTip(0.5, 0.4, 0.1, 1.0) - glm::dvec3(0, 0, 1);
  const glm::dvec3 lever = glm::cross(glm::dvec3(1, 0, 0), arm_now);
  EXPECT_NEAR(held.angles[0], 0.1 + glm::dot(lever, gap) / glm::dot(lever, lever), 1e-12);
}

TEST(JacobianTranspose, AStretchedLimbStaysAsItIs) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const IkSolution solution = SolveJacobianTranspose(arm, Reach(arm, {0, 0}, {0, 0, 1.5}), IkOptions{});
  EXPECT_EQ(solution.status, IkStatus::kStalled);
  EXPECT_EQ(solution.angles, std::vector<double>(2, 0.0));
}

}  // namespace
}  // namespace etude
