#include "bench/statistics/compare.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "bench/statistics/interval.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

MetricInfo Metric(Direction direction, double practical) {
  MetricInfo metric{.id = "position_error_cm", .direction = direction, .practical = practical};
  return metric;
}

std::vector<Pair> PairsWithEffect(double effect, double noise, int count) {
  RandomStream dice({.suite_seed = 1, .scenario = "pairs", .trial = 0}, "x");
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const double world = dice.Normal(50, 20);  // worlds differ much more than methods
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

TEST(ComparePaired, IsUndecidedWhenNoiseHidesTheEffectOrPairsAreFew) {
  EXPECT_EQ(VerdictOf(PairsWithEffect(0, 5, 40), Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kUndecided);
  EXPECT_EQ(VerdictOf(PairsWithEffect(-9, 0.1, 5), Metric(Direction::kLowerIsBetter, 0.1)), Verdict::kUndecided);
  const Comparison none = ComparePaired({}, Metric(Direction::kLowerIsBetter, 0.1), 1, "x");
  EXPECT_EQ(none.verdict, Verdict::kUndecided);
  EXPECT_FALSE(none.difference);
}

TEST(ComparePaired, TakesRoundingForATie) {
  std::vector<Pair> pairs;
  for (int i = 0; i < 12; ++i) pairs.push_back({0.1 * i + 0.3, 0.1 * (i + 3) + 1e-15});  // equal except for rounding
  const Comparison equal = ComparePaired(pairs, Metric(Direction::kLowerIsBetter, 0.05), 1, "x");
  EXPECT_EQ(equal.differing, 0);
  EXPECT_EQ(*equal.difference, 0);
  EXPECT_EQ(*equal.p_holm, 1);
  // Ten steps of ±0.1 are equal in size, so their ranks are tied.
  pairs.clear();
  for (int i = 0; i < 10; ++i) pairs.push_back({0.1 * i, 0.1 * (i < 8 ? i + 1 : i - 1)});
  const Comparison steps = ComparePaired(pairs, Metric(Direction::kLowerIsBetter, 0.05), 1, "x");
  EXPECT_EQ(steps.differing, 10);
  EXPECT_DOUBLE_EQ(*steps.signed_rank.p, 112.0 / 1024);  // binomial: 2 (1 + 10 + 45) / 2¹⁰
  EXPECT_DOUBLE_EQ(*steps.effect_size, -0.6);
}

TEST(ComparePaired, GivesSharesAnIntervalThatDoubtsAFewEqualWorlds) {
  MetricInfo share = Metric(Direction::kHigherIsBetter, 0.02);
  share.aggregate = Aggregate::kMean;
  share.reading = Reading::kYesNo;
  const std::vector<Pair> few(12, Pair{1, 1}), many(400, Pair{1, 1});
  EXPECT_EQ(VerdictOf(few, share), Verdict::kUndecided);
  EXPECT_EQ(VerdictOf(many, share), Verdict::kNoDifference);
  EXPECT_EQ(ComparePaired(few, share, 1, "x").interval, IntervalKind::kAdjustedWald);
}

TEST(ComparePaired, NeverPrefersWithoutADirection) {
  EXPECT_EQ(VerdictOf(PairsWithEffect(-1, 0.5, 40), Metric(Direction::kNeither, 0.1)), Verdict::kUndecided);
  EXPECT_EQ(VerdictOf(PairsWithEffect(-1, 0.5, 40), Metric(Direction::kNeither, 3)), Verdict::kNoDifference);
}

TEST(ComparePaired, TellsTheMeanBesideTheMedian) {
  const Comparison found = ComparePaired(PairsWithEffect(-1, 0.5, 40), Metric(Direction::kLowerIsBetter, 0.1), 1, "x");
  EXPECT_NEAR(*found.mean, -1, 0.25);
  EXPECT_LT(*found.mean_low, *found.mean);
  EXPECT_GT(*found.mean_high, *found.mean);
  EXPECT_NEAR(*found.effect_size, 1, 0.1);
  EXPECT_EQ(found.signed_rank.how, "exact");
  EXPECT_EQ(found.sign_flip.how, "9,999 draws");
}

TEST(ComparePaired, CountsTiesHalf) {
  const std::vector<Pair> pairs = {{1, 0}, {1, 1}, {1, 2}, {1, 0}};
  EXPECT_DOUBLE_EQ(ComparePaired(pairs, Metric(Direction::kLowerIsBetter, 0), 1, "x").share_better, 2.5 / 4);
  EXPECT_DOUBLE_EQ(ComparePaired(pairs, Metric(Direction::kHigherIsBetter, 0), 1, "x").share_better, 1.5 / 4);
}

TEST(AreShares, IsSoWhereEveryValueOfBothMethodsIsZeroOrOne) {
  MetricInfo share = Metric(Direction::kHigherIsBetter, 0.05);
  share.reading = Reading::kShare;
  EXPECT_TRUE(AreShares(std::vector<Pair>{{0, 1}, {1, 1}, {0, 0}, {1, 0}}, share));
  EXPECT_FALSE(AreShares(std::vector<Pair>{{0, 1}, {0.5, 1}}, share));
  EXPECT_FALSE(AreShares(std::vector<Pair>{{0, 1}, {1, 2}}, share));
  EXPECT_FALSE(AreShares(std::vector<Pair>{{0, 1}, {-1, 0}}, share));
  EXPECT_FALSE(AreShares(std::vector<Pair>{{0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}}, share));
  // Values that are all 0 or 1 count as shares only if the metric is of that kind.
  EXPECT_FALSE(AreShares(std::vector<Pair>{{0, 0}, {0, 1}}, Metric(Direction::kLowerIsBetter, 0.05)));
}

// If the values are shares, the mean's interval is computed from the numbers of worlds gained and lost. Otherwise it is
// a bootstrap interval.
TEST(AreShares, DecidesHowTheMeansIntervalIsMade) {
  MetricInfo metric = Metric(Direction::kHigherIsBetter, 0.05);
  metric.aggregate = Aggregate::kMean;
  metric.reading = Reading::kYesNo;
  std::vector<Pair> pairs(20, Pair{0, 0});
  for (int i = 0; i < 4; ++i) pairs[i].method = 1;
  const Interval of_shares = PairedShareInterval(4, 0, 20, kConfidence);
  EXPECT_EQ(ComparePaired(pairs, metric, 1, "x").ci_low, of_shares.low);
  MetricInfo amount = metric;
  amount.reading = Reading::kAmount;
  EXPECT_NE(ComparePaired(pairs, amount, 1, "x").ci_low, of_shares.low);
  for (Pair& pair : pairs) pair.baseline += 2, pair.method += 2;  // the same differences of values that are not shares
  EXPECT_NE(ComparePaired(pairs, metric, 1, "x").ci_low, of_shares.low);
}

}  // namespace
}  // namespace etude
