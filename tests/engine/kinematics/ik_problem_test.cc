#include "engine/kinematics/ik_problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

constexpr int kEndRightFoot = 0, kEndLeftHand = 1, kEndRightHand = 2, kEndHead = 3;  // effectors

// Returns a problem whose targets are a standing body's own effectors. Only the positions of `effectors` have weight.
IkProblem PositionsOf(std::initializer_list<int> effectors) {
  IkProblem problem = DisturbedProblem(Body(), StandingState(Body()), 0, 0);
  for (EffectorTarget& target : problem.targets) {
    target.position_weight = 0;
    target.axis_weights = glm::dvec3(0);
  }
  for (const int e : effectors) problem.targets[e].position_weight = 1;
  return problem;
}

TEST(OutOfReach, NoPoseOfTheTreeIs) {
  for (int trial = 0; trial < 200; ++trial) {
    EXPECT_FALSE(IsOutOfReach(Body(), DisturbedProblem(Body(), RandomPose(Body(), trial, 1), trial, 15))) << trial;
  }
}

// The chain of toe, ankle, knee, hip, half the hips, neck, head.
constexpr double kRootToHead = 0.18 + 0.42 + 0.43 + 0.09 + 0.50 + 0.25;

TEST(OutOfReach, IsWhatLiesBeyondAllLimbsFromTheRoot) {
  IkProblem problem = PositionsOf({kEndHead});
  problem.targets[kEndHead].position = {0, 0, kRootToHead - 1e-6};
  EXPECT_FALSE(IsOutOfReach(Body(), problem));
  problem.targets[kEndHead].position = {0, 0, kRootToHead + 1e-6};
  EXPECT_TRUE(IsOutOfReach(Body(), problem));
  problem.targets[kEndHead].position_weight = 0;
  EXPECT_FALSE(IsOutOfReach(Body(), problem)) << "a position that does not count cannot be out of reach";
}

TEST(OutOfReach, CountsAWholeFramesLimbInItsOwnDirection) {
  IkProblem problem = PositionsOf({kEndHead});
  problem.targets[kEndHead].position = {0, 0, kRootToHead - 1e-6};
  problem.targets[kEndHead].axis_weights = glm::dvec3(1);
  problem.targets[kEndHead].axes = glm::dmat3(1);
  EXPECT_FALSE(IsOutOfReach(Body(), problem)) << "the neck points away from the root";
  problem.targets[kEndHead].axes = glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1);
  EXPECT_TRUE(IsOutOfReach(Body(), problem)) << "the neck's base is asked to be beyond the head";
}

// Both arms and the line between the shoulders, which is rigid.
constexpr double kHandToHand = 2 * (0.18 + 0.25 + 0.29) + 0.36;

TEST(OutOfReach, AreHandsFartherFromEachOtherThanTheArmsAreLong) {
  for (const double beyond : {-1e-6, 1e-6}) {
    IkProblem problem = PositionsOf({kEndLeftHand, kEndRightHand});
    const double half = 0.5 * (kHandToHand + beyond);
    problem.targets[kEndLeftHand].position = {-half, 1, 0};
    problem.targets[kEndRightHand].position = {half, 1, 0};
    EXPECT_EQ(IsOutOfReach(Body(), problem), beyond > 0);
    // Each hand alone is within reach of the root.
    problem.targets[kEndRightHand].position_weight = 0;
    EXPECT_FALSE(IsOutOfReach(Body(), problem));
  }
}

TEST(AllowedRanges, AreTheLimitsAndTheToleranceAroundTheStart) {
  IkProblem problem = PositionsOf({kEndHead});
  problem.start.angles.assign(29, 0.0);
  problem.limits.assign(29, {-0.5, 1.0});
  problem.start.angles[1] = 0.9;
  problem.start.angles[2] = 1.4;  // beyond its limit: the tolerance counts from the limit
  IkOptions options;
  const auto expect = [&](std::vector<AngleRange> expected) {
    const std::vector<AngleRange> ranges = AllowedRanges(problem, options);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(ranges[i].lower, expected[i].lower, 1e-15) << i;
      EXPECT_NEAR(ranges[i].upper, expected[i].upper, 1e-15) << i;
    }
  };
  expect({{-0.5, 1}, {-0.5, 1}, {-0.5, 1}});
  options.angle_change_tolerance = 0.2;
  expect({{-0.2, 0.2}, {0.7, 1}, {0.8, 1}});
  options.limits = false;
  expect({{-0.2, 0.2}, {0.7, 1.1}, {1.2, 1.6}});
}

TEST(WorstError, IsOfTheWorstSingleAxisNotOfTheMeanOfThree) {
  IkProblem problem = PositionsOf({kEndHead});
  std::vector<EffectorError> errors(4);
  errors[kEndHead] = {0.5e-3, {Radians(0.05), Radians(0.12), Radians(0.06)}};
  errors[kEndLeftHand] = {7, glm::dvec3(7)};  // not a target
  for (const int e : {kEndHead, kEndRightFoot}) problem.targets[e].axis_weights = glm::dvec3(1);
  EXPECT_EQ(FindWorst(errors, problem.targets).position, 0.5e-3);
  EXPECT_EQ(FindWorst(errors, problem.targets).axis, Radians(0.12));
  EXPECT_LT(errors[kEndHead].MeanAxisAngle(glm::dvec3(1)), IkOptions{}.axis_goal) << "the mean would pass";
  EXPECT_FALSE(FindWorst(errors, problem.targets).Within({}));
  problem.targets[kEndHead].axis_weights.y = 0;
  EXPECT_EQ(FindWorst(errors, problem.targets).axis, Radians(0.06)) << "an axis of weight 0 does not count";
  EXPECT_TRUE(FindWorst(errors, problem.targets).Within({}));
}

TEST(EffectorError, IsTheMeanOfTheAxesThatCount) {
  const EffectorError error{.position = 0, .axis_angles = {1, 2, 6}};
  EXPECT_EQ(error.MeanAxisAngle(glm::dvec3(1)), 3);
  EXPECT_EQ(error.MeanAxisAngle({5, 0, 0}), 1);
  EXPECT_EQ(error.MeanAxisAngle({0, 0.1, 0}), 2);
  EXPECT_EQ(error.MeanAxisAngle({0, 1, 1}), 4);
  EXPECT_EQ(error.MeanAxisAngle(glm::dvec3(0)), 0);
}

TEST(WorstError, MayBeOfAnyEffector) {
  IkProblem problem = PositionsOf({kEndRightFoot, kEndLeftHand, kEndRightHand, kEndHead});
  for (EffectorTarget& target : problem.targets) target.axis_weights = glm::dvec3(1);
  for (std::size_t e = 0; e < problem.targets.size(); ++e) {
    std::vector<EffectorError> errors(problem.targets.size(), {0.01, glm::dvec3(0.02)});
    errors[e] = {0.03, {0.02, 0.02, 0.05}};
    EXPECT_EQ(FindWorst(errors, problem.targets).position, 0.03) << e;
    EXPECT_EQ(FindWorst(errors, problem.targets).axis, 0.05) << e;
  }
}

// The test vector: 4 cm off, axes off by 10°, 20°, 0°.
EffectorWeights Weights(WeightRule rule) { return ComputeWeights(rule, 0.04, {Radians(10), Radians(20), 0}); }

constexpr double kPerCm2 = 1e4;  // weights are per square metre

TEST(Weights, FixedOnesIgnoreTheErrors) {
  EXPECT_DOUBLE_EQ(Weights(WeightRule::kFixed).position, 1 * kPerCm2);
  EXPECT_EQ(Weights(WeightRule::kFixed).axes, glm::dvec3(1));
  EXPECT_DOUBLE_EQ(Weights(WeightRule::kFixedTuned).position, 0.0015 * kPerCm2);
  EXPECT_DOUBLE_EQ(Weights(WeightRule::kWangChen).position, 0.0007 * kPerCm2);
}

TEST(Weights, AdaptiveOnesFollowEveryErrorByItself) {
  const EffectorWeights plain = Weights(WeightRule::kAdaptive);
  EXPECT_DOUBLE_EQ(plain.position, 4 * kPerCm2);
  EXPECT_NEAR(glm::length(plain.axes - glm::dvec3(10, 20, 0)), 0, 1e-12);
  const EffectorWeights tuned = Weights(WeightRule::kAdaptiveTuned);
  EXPECT_DOUBLE_EQ(tuned.position, 0.012 * kPerCm2);
  EXPECT_EQ(tuned.axes, plain.axes) << "only the position is tuned";
  const EffectorWeights power = Weights(WeightRule::kAdaptivePower);
  EXPECT_NEAR(power.position, 5e-5 * 2.8284271247461903 * kPerCm2, 1e-12) << "4^0.75 = √8";
  EXPECT_NEAR(power.axes.x, std::pow(0.17453292519943295, 0.75), 1e-12);
  EXPECT_EQ(power.axes.z, 0);
}

TEST(Weights, WangAndChensFactorGrowsAsTheDistancesFromTheJointAgree) {
  EXPECT_DOUBLE_EQ(WangChenFactor({2, 0, 0}, {0, 1, 0}), 1.5);
  EXPECT_DOUBLE_EQ(WangChenFactor({1, 0, 0}, {0, 2, 0}), 1.5);
  EXPECT_DOUBLE_EQ(WangChenFactor({1, 0, 0}, {0, 1, 0}), 2);
  EXPECT_DOUBLE_EQ(WangChenFactor({0, 0, 0}, {0, 0, 0}), 1);
}

TEST(Weights, NamesAndRulesMatchBothWays) {
  EXPECT_EQ(FindWeightRule("fixed"), WeightRule::kFixed);
  EXPECT_EQ(FindWeightRule("adaptive-power"), WeightRule::kAdaptivePower);
  EXPECT_EQ(FindWeightRule("wang-chen"), WeightRule::kWangChen);
  EXPECT_EQ(FindWeightRefresh("dof"), WeightRefresh::kDof);
  EXPECT_EQ(FindWeightRule("adaptiv"), std::nullopt);
}

}  // namespace
}  // namespace etude
