#include "engine/kinematics/solvers/linear_targets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

double Square(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

// A problem whose targets weigh differently in everything.
IkProblem Weighted(const KinematicTree& tree, double noise_deg) {
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 0.5), 3, noise_deg);
  problem.targets[0].position_weight = 0.25;
  problem.targets[1].axis_weights = {0.5, 2, 3};
  problem.targets[2].axis_weights = {0, 0, 1};
  problem.targets[3].position_weight = 4;
  return problem;
}

TEST(LinearTargets, SquaresOfTheResidualsAreTheSumNearTheTarget) {
  const KinematicTree tree = MakeBodyTree({});
  for (const double noise_deg : {1.0, 0.1}) {
    const IkProblem problem = Weighted(tree, noise_deg);
    const TreeFrames frames = ComputeFrames(tree, problem.start);
    LinearTargets linear(tree, problem.targets);
    linear.Build(frames);
    EXPECT_GT(linear.Cost(frames), 0);
    // The angle's third power is what first order leaves out.
    EXPECT_NEAR(Square(linear.residuals()) / linear.Cost(frames), 1, 10 * Radians(noise_deg) * Radians(noise_deg));
  }
}

TEST(LinearTargets, TheJacobianFollowsWhatSmallTurnsDoToTheResiduals) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = Weighted(tree, 0);  // at the target, where residuals are linear to second order
  LinearTargets here(tree, problem.targets), there(tree, problem.targets);
  here.Build(ComputeFrames(tree, problem.start));
  ASSERT_LT(Square(here.residuals()), 1e-20);
  constexpr double kStep = 1e-5;
  for (int dof = 0; dof < tree.dof_count(); ++dof) {
    TreeState turned = problem.start;
    turned.angles[dof] += kStep;
    there.Build(ComputeFrames(tree, turned));
    for (int row = 0; row < here.rows(); ++row) {
      EXPECT_NEAR(-there.residuals()[row] / kStep, here.jacobian()[dof * here.rows() + row], 2e-4) << dof << " " << row;
    }
  }
}

TEST(LinearTargets, HaveNoRowsForWhatHasNoWeight) {
  const KinematicTree tree = MakeBodyTree({});
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 0.5), 3, 5);
  const auto rows = [&] {
    LinearTargets linear(tree, problem.targets);
    linear.Build(ComputeFrames(tree, problem.start));
    EXPECT_EQ(linear.jacobian().size(), static_cast<std::size_t>(linear.rows() * linear.columns()));
    return linear.rows();
  };
  EXPECT_EQ(rows(), 24);
  problem.targets[0].axis_weights = {0, 0, 1};  // a direction has two degrees of freedom
  EXPECT_EQ(rows(), 23);
  problem.targets[1].position_weight = 0;
  EXPECT_EQ(rows(), 20);
  for (EffectorTarget& target : problem.targets) {
    target.position_weight = 0;
    target.axis_weights = glm::dvec3(0);
  }
  EXPECT_EQ(rows(), 0);
}

TEST(LinearTargets, StepsEndAtTheRangesAndAreShortenedAsAWhole) {
  std::vector<double> step = {0.3, -1.2, 0.6};
  Shorten(step);
  EXPECT_NEAR(step[0], 0.15, 1e-15);
  EXPECT_NEAR(step[1], -0.6, 1e-15);
  EXPECT_NEAR(step[2], 0.3, 1e-15);
  Shorten(step);
  EXPECT_NEAR(step[1], -0.6, 1e-15) << "short enough";
  const std::vector<AngleRange> ranges = {{-1, 0.1}, {-1, 1}, {0, 0}};
  std::vector<double> angles = {0, 0.5, 0};
  EXPECT_NEAR(MoveWithin(ranges, angles, step, angles), 0.6, 1e-15);
  EXPECT_NEAR(angles[0], 0.1, 1e-15);
  EXPECT_NEAR(angles[1], -0.1, 1e-15);
  EXPECT_EQ(angles[2], 0);
}

}  // namespace
}  // namespace etude
