#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/jacobian_solvers.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"
#include "tests/engine/kinematics/solvers/plain_gauss_newton.h"

namespace etude {
namespace {

struct Linearised {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residuals, preferred, step;
};

// Returns a step at a random pose of the body, and its inputs.
Linearised StepAt(int trial, double noise_deg, double damping) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.8), trial, noise_deg);
  LinearTargets linear(Body(), problem.targets);
  linear.Build(ComputeFrames(Body(), problem.start));
  Linearised made{Eigen::Map<const Eigen::MatrixXd>(linear.jacobian().data(), linear.rows(), linear.columns()),
                  Eigen::Map<const Eigen::VectorXd>(linear.residuals().data(), linear.rows()),
                  Eigen::VectorXd(linear.columns()),
                  {}};
  for (int i = 0; i < linear.columns(); ++i) made.preferred[i] = std::sin(3 * i + trial);
  DampedInverse inverse;
  inverse.Build(linear);
  std::vector<double> step;
  EXPECT_TRUE(inverse.Step(damping, {made.preferred.data(), 29}, step));
  made.step = Eigen::Map<const Eigen::VectorXd>(step.data(), 29);
  return made;
}

TEST(DampedInverse, StepsAsThePseudoInverseBySingularValuesDoes) {
  for (int trial = 0; trial < 10; ++trial) {
    const Linearised made = StepAt(trial, 15, 0);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(made.jacobian, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(29, 24);
    for (int i = 0; i < 24; ++i) {
      inverse += svd.matrixV().col(i) * svd.matrixU().col(i).transpose() / svd.singularValues()[i];
    }
    const Eigen::MatrixXd null_space = Eigen::MatrixXd::Identity(29, 29) - inverse * made.jacobian;
    const Eigen::VectorXd expected = inverse * made.residuals + null_space * made.preferred;
    EXPECT_LT((made.step - expected).norm(), 1e-7 * expected.norm()) << trial;
    EXPECT_GT((null_space * made.preferred).norm(), 0.1) << "five degrees of freedom are left to the preferred posture";
  }
}

TEST(DampedInverse, ThePreferredPostureMovesNoEffector) {
  for (int trial = 0; trial < 10; ++trial) {
    const Linearised at_target = StepAt(trial, 0, 0);
    ASSERT_LT(at_target.residuals.norm(), 1e-12);
    EXPECT_LT((at_target.jacobian * at_target.step).norm(), 1e-8);
    EXPECT_GT(at_target.step.norm(), 0.1);
    const Linearised off_target = StepAt(trial, 15, 0);
    EXPECT_LT((off_target.jacobian * off_target.step - off_target.residuals).norm(), 1e-8);
  }
}

TEST(DampedInverse, DampingShortensTheWayToTheTargets) {
  const Linearised free = StepAt(4, 15, 0), damped = StepAt(4, 15, 1);
  EXPECT_LT((damped.step - damped.preferred).norm(), (free.step - free.preferred).norm());
  EXPECT_GT((damped.jacobian * damped.step - damped.residuals).norm(), 1e-3);
}

TEST(DampedInverse, SaysWhenThereIsNone) {
  const KinematicTree arm = Arm({0.5, 0.4}, 3);
  const std::vector<double> none_preferred(6, 0.0);
  std::vector<double> step;
  const auto has_step = [&](double elbow, double damping) {
    const IkProblem problem = Reach(arm, {0, 0, 0, elbow, 0, 0}, {0, 0, 1.5});
    LinearTargets linear(arm, problem.targets);
    linear.Build(ComputeFrames(arm, problem.start));
    DampedInverse inverse;
    inverse.Build(linear);
    return inverse.Step(damping, none_preferred, step);
  };
  EXPECT_FALSE(has_step(0, 0)) << "a stretched arm cannot move its tip along itself";
  EXPECT_TRUE(has_step(0.1, 0));
  EXPECT_TRUE(has_step(0, 1e-3));
  for (const double turn : step) EXPECT_EQ(turn, 0) << "and nothing pulls it sideways";
}

// A step within limits at a random pose, its inputs, and the clamped result of Step.
struct StepWithinLimits {
  IkProblem problem;
  std::vector<double> preferred, step, clamped;
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residuals;
  bool is_exact = false;
};

StepWithinLimits StepWithinAt(int trial, double damping) {
  StepWithinLimits made{.problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 15)};
  const std::vector<double>& angles = made.problem.start.angles;
  const std::vector<double> wanted = RandomPose(Body(), trial + 1000, 0.5).angles;
  for (std::size_t i = 0; i < angles.size(); ++i) made.preferred.push_back(0.2 * (wanted[i] - angles[i]));
  LinearTargets linear(Body(), made.problem.targets);
  linear.Build(ComputeFrames(Body(), made.problem.start));
  made.jacobian = Eigen::Map<const Eigen::MatrixXd>(linear.jacobian().data(), linear.rows(), linear.columns());
  made.residuals = Eigen::Map<const Eigen::VectorXd>(linear.residuals().data(), linear.rows());
  DampedInverse inverse;
  inverse.Build(linear);
  EXPECT_TRUE(inverse.Step(damping, made.preferred, made.clamped));
  std::vector<double> ends;
  MoveWithin(made.problem.limits, angles, made.clamped, ends);
  for (std::size_t i = 0; i < angles.size(); ++i) made.clamped[i] = ends[i] - angles[i];
  EXPECT_TRUE(inverse.StepWithin(damping, made.preferred, angles, made.problem.limits, made.step));
  made.is_exact = inverse.is_exact();
  return made;
}

double Objective(const StepWithinLimits& made, double damping, const std::vector<double>& step) {
  const Eigen::Map<const Eigen::VectorXd> taken(step.data(), 29), wish(made.preferred.data(), 29);
  return (made.jacobian * taken - made.residuals).squaredNorm() + damping * (taken - wish).squaredNorm();
}

// A second implementation: minimises one angle at a time within its range; slow, but without an active set.
std::vector<double> ByCoordinateDescent(const StepWithinLimits& made, double damping) {
  std::vector<double> step(29, 0.0);
  Eigen::VectorXd left = made.residuals;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    for (int i = 0; i < 29; ++i) {
      const double angle = made.problem.start.angles[i];
      const auto column = made.jacobian.col(i);
      const double best = (column.dot(left) + column.squaredNorm() * step[i] + damping * made.preferred[i]) /
                          (column.squaredNorm() + damping);
      const double turn = std::clamp(best, made.problem.limits[i].lower - angle, made.problem.limits[i].upper - angle);
      left -= (turn - step[i]) * column;
      step[i] = turn;
    }
  }
  return step;
}

TEST(DampedInverse, StepsWithinLimitsAsCoordinateDescentDoes) {
  constexpr double kDamping = 0.05;
  int exact = 0, beside = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const StepWithinLimits made = StepWithinAt(trial, kDamping);
    const double expected = Objective(made, kDamping, ByCoordinateDescent(made, kDamping));
    beside += Objective(made, kDamping, made.clamped) > 1.01 * expected;
    if (!made.is_exact) continue;
    ++exact;
    EXPECT_NEAR(Objective(made, kDamping, made.step), expected, 1e-9 * expected) << trial;
  }
  EXPECT_GE(exact, 30);
  EXPECT_GE(beside, 20) << "clamping must show";
}

// The same optimum by Featherstone's elimination along the limbs, which needs no matrix of the whole body.
TEST(DampedInverse, StepsWithinLimitsAsGaussNewtonStepDoes) {
  for (const double damping : {1e-3, 0.1, 1.0}) {
    int both = 0, held = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const StepWithinLimits made = StepWithinAt(trial, damping);
      const std::vector<double>& angles = made.problem.start.angles;
      std::vector<double> posture(29);
      for (int i = 0; i < 29; ++i) posture[i] = angles[i] + made.preferred[i];
      GaussNewtonStep other(Body(), made.problem.targets);
      other.Build(ComputeFrames(Body(), made.problem.start));
      std::span<const double> expected;
      for (int pass = 0; pass < 40 && !other.is_exact(); ++pass) {
        expected = other.Solve(angles, posture, made.problem.limits, damping);
      }
      for (int i = 0; i < 29; ++i) {
        const AngleRange& range = made.problem.limits[i];
        EXPECT_GE(made.step[i], range.lower - angles[i]);
        EXPECT_LE(made.step[i], range.upper - angles[i]);
      }
      if (!made.is_exact || !other.is_exact()) continue;
      ++both;
      for (int i = 0; i < 29; ++i) {
        EXPECT_NEAR(made.step[i], expected[i], 1e-8) << trial;
        const AngleRange& range = made.problem.limits[i];
        held += made.step[i] == range.lower - angles[i] || made.step[i] == range.upper - angles[i];
      }
    }
    EXPECT_GE(both, damping < 0.01 ? 45 : 170) << damping;
    EXPECT_GT(held, both / 2) << "else no bound was put to the test";
  }
}

TEST(DampedInverse, StepsWithinWideLimitsAsWithoutAny) {
  const std::vector<AngleRange> wide(29, {-1e6, 1e6});
  for (int trial = 0; trial < 10; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.8), trial, 15);
    LinearTargets linear(Body(), problem.targets);
    linear.Build(ComputeFrames(Body(), problem.start));
    DampedInverse inverse;
    inverse.Build(linear);
    const std::vector<double> preferred(29, 0.1);
    std::vector<double> free, within;
    for (const double damping : {0.0, 0.1}) {
      ASSERT_TRUE(inverse.Step(damping, preferred, free));
      ASSERT_TRUE(inverse.StepWithin(damping, preferred, problem.start.angles, wide, within));
      EXPECT_TRUE(inverse.is_exact());
      for (int i = 0; i < 29; ++i) EXPECT_NEAR(within[i], free[i], 1e-7);
    }
  }
}

TEST(DampedInverse, TellsWhatAStepGainsToFirstOrder) {
  const StepWithinLimits made = StepWithinAt(3, 0.1);
  LinearTargets linear(Body(), made.problem.targets);
  linear.Build(ComputeFrames(Body(), made.problem.start));
  DampedInverse inverse;
  inverse.Build(linear);
  const double gain = made.residuals.squaredNorm() - Objective(made, 0, made.step);
  EXPECT_NEAR(inverse.Gain(made.step), gain, 1e-12 * made.residuals.squaredNorm());
  EXPECT_GT(gain, 0);
}

// Four of the six angles are fixed. The other two cannot satisfy three coordinates, so without damping there is no
// solution.
TEST(DampedInverse, SaysWhenLimitsLeaveNoStep) {
  const KinematicTree arm = Arm({0.5, 0.4}, 3);
  const IkProblem problem = Reach(arm, {0, 0, 0, 0.5, 0, 0}, {0.02, -0.17, 1.82});
  LinearTargets linear(arm, problem.targets);
  linear.Build(ComputeFrames(arm, problem.start));
  DampedInverse inverse;
  inverse.Build(linear);
  const std::vector<double> none_preferred(6, 0.0);
  std::vector<double> step;
  EXPECT_TRUE(inverse.StepWithin(0, none_preferred, problem.start.angles, arm.limits, step));
  std::vector<AngleRange> stiff = arm.limits;
  for (const int i : {0, 1, 2, 4}) stiff[i] = {problem.start.angles[i], problem.start.angles[i]};
  EXPECT_FALSE(inverse.StepWithin(0, none_preferred, problem.start.angles, stiff, step));
  ASSERT_TRUE(inverse.StepWithin(0.1, none_preferred, problem.start.angles, stiff, step));
  for (const int i : {0, 1, 2, 4}) EXPECT_EQ(step[i], 0);
}

}  // namespace
}  // namespace etude
