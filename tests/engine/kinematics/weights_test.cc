#include "engine/kinematics/weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

// The test vector: 4 cm off, axes off by 10°, 20°, 0°.
EffectorWeights Weights(WeightRule rule) { return ComputeWeights(rule, 0.04, {Radians(10), Radians(20), 0}); }

constexpr double kPerCm2 = 1e4;  // weights are kept per square metre

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
