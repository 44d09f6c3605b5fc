#include "engine/kinematics/solvers/moment_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/solvers/ccd_sweep.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

/// The largest difference of an angle between both forms of the sweep, over poses and sweeps.
double LargestDifference(WeightRule rule, bool limits, int sweeps) {
  const KinematicTree tree = MakeBodyTree({});
  double largest = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 30);
    IkOptions options;
    options.weights = rule;
    options.limits = limits;
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
    EXPECT_LT(LargestDifference(rule, true, 10), 1e-9) << WeightRuleNames()[static_cast<int>(rule)];
    EXPECT_LT(LargestDifference(rule, false, 10), 1e-9) << WeightRuleNames()[static_cast<int>(rule)];
  }
}

TEST(MomentSweep, KeepsItsFramesOrthonormalOverThousandsOfSweeps) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 1.0), 3, 30);
  IkOptions options;
  options.weights = WeightRule::kFixedTuned;
  MomentSweep moments(tree, problem, options);
  for (int sweep = 0; sweep < 5000; ++sweep) moments.Sweep();
  const TreeFrames frames =
      ComputeFrames(tree, {problem.start.root_position, problem.start.root_frame, moments.Angles()});
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const EffectorError exact = ErrorOf(frames.effectors[e], problem.targets[e]);
    EXPECT_NEAR(moments.errors()[e].position, exact.position, 1e-12);
  }
}

}  // namespace
}  // namespace etude
