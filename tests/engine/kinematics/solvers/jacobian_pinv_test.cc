#include "engine/kinematics/solvers/jacobian_pinv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

TEST(JacobianPinv, FindsTheAnglesOfAnElbowByTheLawOfCosines) {
  KinematicTree arm = Arm({0.5, 0.4}, 1);
  arm.joints[1].dof_count = 2;  // out of the plane, too: three angles for three coordinates
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
  // Figure 3.8: a limb stretched, its target on its own line.
  const KinematicTree arm = Arm({0.5, 0.4}, 3);
  const IkProblem problem = Reach(arm, std::vector<double>(6, 0.0), {0, 0, 1.5});
  for (const double damping : {0.0, 0.1}) {
    const IkSolution solution = SolveJacobianPinv(arm, problem, {}, {.damping = damping});
    EXPECT_EQ(solution.status, IkStatus::kStalled);
    EXPECT_EQ(solution.angles, problem.start.angles);
    EXPECT_EQ(solution.iterations, damping > 0 ? 1 : 0);
  }
  // Bent a little, the same arm gets there.
  EXPECT_EQ(SolveJacobianPinv(arm, Reach(arm, {0, 0, 0, 0.3, 0, 0}, {0, 0, 1.5}), {}).status, IkStatus::kConverged);
}

TEST(JacobianPinv, StaysNearerToTheStartThanStepsWithoutAPreferredPosture) {
  const KinematicTree tree = MakeBodyTree({});
  IkOptions options;
  options.limits = false;
  double with_posture = 0, without = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.5), trial, 15);
    const auto square = [&](const std::vector<double>& angles) {
      double sum = 0;
      for (std::size_t i = 0; i < angles.size(); ++i) sum += std::pow(angles[i] - problem.start.angles[i], 2);
      return sum;
    };
    const IkSolution solution = SolveJacobianPinv(tree, problem, options);
    ASSERT_EQ(solution.status, IkStatus::kConverged) << trial;
    with_posture += square(solution.angles);
    // The same steps, each starting afresh.
    IkProblem problem_now = problem;
    IkOptions one_step = options;
    one_step.max_iterations = 1;
    for (int i = 0; i < solution.iterations; ++i) {
      problem_now.start.angles = SolveJacobianPinv(tree, problem_now, one_step).angles;
    }
    without += square(problem_now.start.angles);
  }
  EXPECT_LT(with_posture, without);
}

// Near their limits clamped angles are not made up for by others.
TEST(JacobianPinv, ByAnActiveSetSolvesWhereLimitsBind) {
  const KinematicTree tree = MakeBodyTree({});
  IkOptions options;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
  options.max_iterations = 100;
  const auto solved_by = [&](Bounds bounds) {
    int solved = 0;
    for (int trial = 0; trial < 100; ++trial) {
      const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 15);
      const IkSolution solution = SolveJacobianPinv(tree, problem, options, {.bounds = bounds});
      solved += solution.status == IkStatus::kConverged;
      for (int i = 0; i < 29; ++i) {
        EXPECT_TRUE(solution.angles[i] >= tree.limits[i].lower && solution.angles[i] <= tree.limits[i].upper);
      }
    }
    return solved;
  };
  EXPECT_GE(solved_by(Bounds::kActiveSet), 88);
  EXPECT_LE(solved_by(Bounds::kClamped), 60) << "else the active set is not what solves them";
}

TEST(JacobianPinv, StepsAlikeWithAndWithoutAnActiveSetFarFromTheLimits) {
  const KinematicTree tree = MakeBodyTree({});
  IkOptions options;
  options.limits = false;
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.5), trial, 15);
    const IkSolution clamped = SolveJacobianPinv(tree, problem, options);
    const IkSolution active = SolveJacobianPinv(tree, problem, options, {.bounds = Bounds::kActiveSet});
    EXPECT_EQ(active.iterations, clamped.iterations);
    for (int i = 0; i < 29; ++i) EXPECT_NEAR(active.angles[i], clamped.angles[i], 1e-6);
  }
}

}  // namespace
}  // namespace etude
