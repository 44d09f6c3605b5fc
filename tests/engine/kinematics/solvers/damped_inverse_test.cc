#include "engine/kinematics/solvers/damped_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

struct Linearised {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residuals, preferred, step;
};

// The step and what it is made of, at a random pose of the body.
Linearised StepAt(int trial, double noise_deg, double damping) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 0.8), trial, noise_deg);
  LinearTargets linear(tree, problem.targets);
  linear.Build(ComputeFrames(tree, problem.start));
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

}  // namespace
}  // namespace etude
