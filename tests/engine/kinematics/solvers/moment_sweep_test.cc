#include "engine/kinematics/solvers/moment_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ccd.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

/// Returns the largest difference of an angle between both forms of the sweep, over poses and sweeps.
double LargestDifference(const KinematicTree& tree, WeightRule rule, bool limits, int sweeps) {
  double largest = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 30);
    IkOptions options{.weights = rule, .limits = limits};
    CcdSweep reference(tree, problem, options, CcdJoint::kHinges);
    MomentSweep moments(tree, problem, options);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      reference.Sweep();
      moments.Sweep();
      const std::vector<double> angles = moments.Angles();
      for (std::size_t i = 0; i < angles.size(); ++i) {
        largest = std::max(largest, std::abs(std::remainder(angles[i] - reference.angles()[i], 2 * kPi)));
      }
    }
  }
  return largest;
}

TEST(MomentSweep, TurnsEveryAngleLikeTheSweepThatGoesFromEffectorToEffector) {
  for (const WeightRule rule :
       {WeightRule::kFixed, WeightRule::kFixedTuned, WeightRule::kAdaptive, WeightRule::kAdaptivePower}) {
    EXPECT_LT(LargestDifference(MakeBodyTree({}), rule, true, 10), 1e-9) << WeightRuleNames()[static_cast<int>(rule)];
    EXPECT_LT(LargestDifference(MakeBodyTree({}), rule, false, 10), 1e-9) << WeightRuleNames()[static_cast<int>(rule)];
  }
}

TEST(MomentSweep, KnowsTreesWhoseLimbsRestAskewAndCarryEffectorsAnywhere) {
  KinematicTree tree = MakeBodyTree({});
  for (TreeJoint& joint : tree.joints) joint.R_PJ *= RotationXyz({0.3, -0.4, 0.2});
  tree.effectors.push_back({"left_palm", kTreeLeftWrist, {0.05, 0.02, 0.1}});
  tree.effectors.push_back({"chest", kTreeNavel, {0, 0.1, 0.4}});
  tree.effectors.push_back({"elbow", kTreeRightElbow, {0.03, 0, 0.01}});
  for (const WeightRule rule : {WeightRule::kFixedTuned, WeightRule::kAdaptivePower}) {
    EXPECT_LT(LargestDifference(tree, rule, true, 10), 1e-9) << WeightRuleNames()[static_cast<int>(rule)];
  }
}

TEST(MomentSweep, TellsErrorsLikeForwardKinematics) {
  IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 5, 0.7), 5, 60);
  problem.targets[1].axis_weights = {1, 0, 0.5};
  const IkOptions options;
  const MomentSweep moments(Body(), problem, options);
  const TreeFrames frames = ComputeFrames(Body(), problem.start);
  double largest_angle = 0;
  for (std::size_t e = 0; e < Body().effectors.size(); ++e) {
    const EffectorError exact = ErrorOf(frames.effectors[e], problem.targets[e]);
    EXPECT_NEAR(moments.errors()[e].position, exact.position, 1e-12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(moments.errors()[e].axis_angles[k], exact.axis_angles[k], 1e-11);
      largest_angle = std::max(largest_angle, exact.axis_angles[k]);
    }
  }
  EXPECT_GT(largest_angle, Radians(100)) << "angles beyond a right one must have been met";
}

TEST(MomentSweep, DoesNotMissGoalsThatItHasMet) {
  IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 6, 0.7), 6, 0);
  const IkOptions options;
  EXPECT_FALSE(MomentSweep(Body(), problem, options).MissesGoals());
  problem.targets[2].position.y += 0.0011;
  EXPECT_TRUE(MomentSweep(Body(), problem, options).MissesGoals()) << "0.11 cm";
  problem.targets[2].position_weight = 0;
  EXPECT_FALSE(MomentSweep(Body(), problem, options).MissesGoals()) << "a position of no weight";
  problem.targets[0].axes = AxisRotation({1, 0, 0}, Radians(0.2)) * problem.targets[0].axes;
  EXPECT_TRUE(MomentSweep(Body(), problem, options).MissesGoals());
}

TEST(MomentSweep, KeepsItsFramesOrthonormalOverThousandsOfSweeps) {
  const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), 3, 1.0), 3, 30);
  IkOptions options{.weights = WeightRule::kFixedTuned};
  MomentSweep moments(Body(), problem, options);
  for (int sweep = 0; sweep < 5000; ++sweep) moments.Sweep();
  const TreeFrames frames =
      ComputeFrames(Body(), {problem.start.root_position, problem.start.root_frame, moments.Angles()});
  for (std::size_t e = 0; e < Body().effectors.size(); ++e) {
    const EffectorError exact = ErrorOf(frames.effectors[e], problem.targets[e]);
    EXPECT_NEAR(moments.errors()[e].position, exact.position, 1e-12);
  }
}

}  // namespace
}  // namespace etude
