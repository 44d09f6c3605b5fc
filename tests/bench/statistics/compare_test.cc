#include "bench/statistics/compare.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

MetricInfo Metric(Direction direction, double practical) {
  MetricInfo metric;
  metric.id = "position_error_cm";
  metric.direction = direction;
  metric.practical = practical;
  return metric;
}

std::vector<Pair> PairsWithEffect(double effect, double noise, int count) {
  RandomStream dice({.suite_seed = 1, .scenario = "pairs", .trial = 0}, "x");
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const double world = dice.Normal(50, 20);  // worlds differ far more than methods do
    pairs.push_back({world, world + effect + dice.Normal(0, noise)});
  }
  return pairs;
}

Verdict VerdictOf(const std::vector<Pair>& pairs, const MetricInfo& metric) {
  return ComparePaired(pairs, metric, 1, "x").verdict;
}

TEST(ComparePaired, SeesASmallEffectThroughLargeDifferencesOfWorlds) {
  const auto lower = PairsWithEffect(-1, 0.5, 40);
  EXPECT_EQ(VerdictOf(lower, Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kBetter);
  EXPECT_EQ(VerdictOf(lower, Metric(Direction::kHigherIsBetter, 0.1)), Verdict::kWorse);
  EXPECT_EQ(VerdictOf(PairsWithEffect(1, 0.5, 40), Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kWorse);
}

TEST(ComparePaired, CallsAnEffectBelowThePracticalThresholdNoDifference) {
  EXPECT_EQ(VerdictOf(PairsWithEffect(-1, 0.5, 40), Metric(Direction::kLowerIsBetter, 2)), Verdict::kNoDifference);
  const std::vector<Pair> identical(20, Pair{3, 3});
  EXPECT_EQ(VerdictOf(identical, Metric(Direction::kLowerIsBetter, 0)), Verdict::kNoDifference);
}

TEST(ComparePaired, IsInconclusiveWhenNoiseHidesTheEffectOrPairsAreFew) {
  EXPECT_EQ(VerdictOf(PairsWithEffect(0, 5, 40), Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kInconclusive);
  EXPECT_EQ(VerdictOf(PairsWithEffect(-9, 0.1, 5), Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kInconclusive);
  const Comparison none = ComparePaired({}, Metric(Direction::kLowerIsBetter, 0.1), 1, "x");
  EXPECT_EQ(none.verdict, Verdict::kInconclusive);
  EXPECT_FALSE(none.difference);
}

TEST(ComparePaired, CountsTiesHalf) {
  const std::vector<Pair> pairs = {{1, 0}, {1, 1}, {1, 2}, {1, 0}};
  EXPECT_DOUBLE_EQ(ComparePaired(pairs, Metric(Direction::kLowerIsBetter, 0), 1, "x").share_better, 2.5 / 4);
  EXPECT_DOUBLE_EQ(ComparePaired(pairs, Metric(Direction::kHigherIsBetter, 0), 1, "x").share_better, 1.5 / 4);
}

}  // namespace
}  // namespace etude
