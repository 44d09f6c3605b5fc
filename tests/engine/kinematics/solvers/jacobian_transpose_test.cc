#include "engine/kinematics/solvers/jacobian_transpose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

// The sum of squares after every iteration.
std::vector<double> Costs(const KinematicTree& tree, const IkProblem& problem, IkOptions options, double gain = 1) {
  options.trace = true;
  const LinearTargets linear(tree, problem.targets);
  std::vector<double> costs;
  for (const IkTraceEntry& entry : SolveJacobianTranspose(tree, problem, options, {.gain = gain}).trace) {
    TreeState state = problem.start;
    state.angles = entry.angles;
    costs.push_back(linear.Cost(ComputeFrames(tree, state)));
  }
  return costs;
}

TEST(JacobianTranspose, OneHingeTurnsByItsTorqueOverTheSquareOfItsLever) {
  const KinematicTree arm = Arm({0.5}, 1);
  const IkProblem problem = Reach(arm, {0.3}, {0, -0.5 * std::sin(0.5), 1 + 0.5 * std::cos(0.5)});
  for (const double gain : {1.0, 0.25}) {
    IkOptions options;
    options.max_iterations = 1;
    // J is the lever, 0.5 m across the limb; of dX only what lies along J counts: 0.5 m times the sine of 0.2 rad.
    EXPECT_NEAR(SolveJacobianTranspose(arm, problem, options, {.gain = gain}).angles[0], 0.3 + gain * std::sin(0.2),
                1e-12);
  }
}

TEST(JacobianTranspose, NoStepIsLongerThanFirstOrderIsGoodFor) {
  const KinematicTree arm = Arm({0.5}, 1);
  IkOptions options;
  options.max_iterations = 1;
  const IkProblem problem = Reach(arm, {0.3}, {0, -0.5 * std::sin(1.8), 1 + 0.5 * std::cos(1.8)});
  ASSERT_GT(std::sin(1.5), kLargestTurn) << "the step of a gain of 1";
  EXPECT_NEAR(SolveJacobianTranspose(arm, problem, options).angles[0], 0.3 + kLargestTurn, 1e-12);
}

TEST(JacobianTranspose, FindsTheAnglesOfTwoHingesByTheLawOfCosines) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.7, 1.2);
  const IkSolution solution = SolveJacobianTranspose(arm, Reach(arm, {0.4, 1.5}, place), Exactly());
  EXPECT_EQ(solution.status, IkStatus::kConverged);
  EXPECT_NEAR(solution.angles[0], 0.7, 1e-8);
  EXPECT_NEAR(solution.angles[1], ElbowAngle(0.5, 0.4, glm::distance(place, {0, 0, 1})), 1e-8);
}

TEST(JacobianTranspose, EveryStepLowersTheSumOfSquaresNearTheTarget) {
  const KinematicTree tree = MakeBodyTree({});
  int steps = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.5), trial, 3);
    for (const bool limits : {false, true}) {
      IkOptions options;
      options.limits = limits;
      options.max_iterations = 100;
      const std::vector<double> costs = Costs(tree, problem, options);
      for (std::size_t i = 1; i < costs.size(); ++i, ++steps) {
        // A limb that is clamped on its way loses part of its step.
        ASSERT_LT(costs[i], costs[i - 1] * (limits ? 1.05 : 1)) << trial << " step " << i;
      }
    }
  }
  EXPECT_GT(steps, 500);
}

TEST(JacobianTranspose, TooLongStepsRaiseTheSumOfSquares) {
  const KinematicTree tree = MakeBodyTree({});
  IkOptions options;
  options.limits = false;
  options.max_iterations = 100;
  const std::vector<double> costs = Costs(tree, DisturbedProblem(tree, RandomPose(tree, 0, 0.5), 0, 3), options, 2.5);
  EXPECT_GT(*std::max_element(costs.begin() + 1, costs.end()), costs[0]) << "else monotony proves nothing";
}

TEST(JacobianTranspose, AnAngleThatIsPushedOutOfItsRangeTakesNoPart) {
  const KinematicTree arm = Arm({0.5, 0.4}, 1);
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.3, 1.4);
  IkProblem problem = Reach(arm, {0.1, 1.0}, place);
  problem.limits[1] = {0, 1.0};
  IkOptions options;
  options.max_iterations = 1;
  const IkSolution held = SolveJacobianTranspose(arm, problem, options);
  EXPECT_EQ(held.angles[1], 1.0);
  // As if the forearm were no joint at all.
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
