#include "bench/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "engine/base/order_statistics.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// Efron & Tibshirani (1993), An Introduction to the Bootstrap, table 14.1: the spatial test data, A.
const std::vector<double> kSpatial = {48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                      0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};

double PlugInVariance(std::span<const double> values) {
  double squares = 0;
  for (double value : values) squares += (value - Mean(values)) * (value - Mean(values));
  return squares / static_cast<double>(values.size());
}

std::vector<double> Replicates(std::span<const double> values, int count,
                               double (*statistic)(std::span<const double>)) {
  RandomStream dice({.suite_seed = 1, .scenario = "t", .trial = 0}, "replicates");
  std::vector<double> replicates, resample(values.size());
  for (int i = 0; i < count; ++i) {
    for (double& value : resample) value = values[dice.IndexBelow(values.size())];
    replicates.push_back(statistic(resample));
  }
  return replicates;
}

std::vector<double> Jackknife(const std::vector<double>& values, double (*statistic)(std::span<const double>)) {
  std::vector<double> left_out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<double> others = values;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    left_out.push_back(statistic(others));
  }
  return left_out;
}

TEST(BcaInterval, IsThatOfEfronAndTibshiranisVariance) {
  // Table 14.2: 90 % intervals of the variance, BCa (115.8, 259.6), percentile (100.8, 233.9).
  auto replicates = Replicates(kSpatial, 19999, PlugInVariance);
  const double estimate = PlugInVariance(kSpatial);
  EXPECT_NEAR(estimate, 171.5, 0.05);
  const Interval bca = BcaInterval(replicates, estimate, Jackknife(kSpatial, PlugInVariance), 0.9);
  EXPECT_EQ(bca.kind, IntervalKind::kBca);
  EXPECT_NEAR(bca.low, 115.8, 2);
  EXPECT_NEAR(bca.high, 259.6, 3);
  // With a jackknife of no spread, the BCa interval equals the percentile interval, which differs from the one above.
  const Interval percentile = BcaInterval(replicates, estimate, std::vector<double>(26, 3.0), 0.9);
  EXPECT_EQ(percentile.kind, IntervalKind::kPercentile);
  EXPECT_NEAR(percentile.low, 100.8, 4);  // the book uses 2,000 replicates
  EXPECT_NEAR(percentile.high, 233.9, 3);
}

TEST(BcaInterval, FallsBackWhenAllReplicatesLieOnOneSide) {
  std::vector<double> replicates(1999);
  for (std::size_t i = 0; i < replicates.size(); ++i) replicates[i] = static_cast<double>(i);
  const std::vector<double> jackknife = {1, 2, 3, 4, 5, 7};
  EXPECT_EQ(BcaInterval(replicates, 999, jackknife).kind, IntervalKind::kBca);
  EXPECT_EQ(BcaInterval(replicates, -1, jackknife).kind, IntervalKind::kPercentile);
  const Interval above = BcaInterval(replicates, 5000, jackknife);
  EXPECT_EQ(above.kind, IntervalKind::kPercentile);
  EXPECT_EQ(above.low, 49);  // the 50th of 1,999 replicates
  EXPECT_EQ(above.high, 1949);
}

TEST(BootstrapInterval, AgreesWithScipy) {
  // scipy 1.10.1: stats.bootstrap((values,), numpy.mean, method='BCa', n_resamples=200000); its percentile
  // interval is (1.580, 8.152).
  const std::vector<double> skewed = {0.3011942119122021, 0.4965853037914096, 1.1051709180756477, 1.4918246976412703,
                                      2.45960311115695,   3.6692966676192444, 6.0496474644129465, 13.463738035001692,
                                      0.8187307530779818, 1.8221188003905089, 20.085536923187668, 1.3498588075760032};
  const auto mean = BootstrapInterval(skewed, Aggregate::kMean, 1, "x");
  EXPECT_NEAR(mean->low, 1.980, 0.12);
  EXPECT_NEAR(mean->high, 9.425, 0.5);
  const auto median = BootstrapInterval(kSpatial, Aggregate::kMedian, 1, "x");
  EXPECT_EQ(median->low, 24);
  EXPECT_EQ(median->high, 41);
}

TEST(BootstrapInterval, NeedsSixValues) {
  const std::vector<double> five = {1, 2, 3, 4, 5}, six = {1, 2, 3, 4, 5, 6};
  EXPECT_FALSE(BootstrapInterval(five, Aggregate::kMedian, 1, "x"));
  EXPECT_TRUE(BootstrapInterval(six, Aggregate::kMedian, 1, "x"));
}

TEST(BootstrapInterval, OfOneValueAllOverIsThatValueAndNoBca) {
  for (Aggregate aggregate : {Aggregate::kMedian, Aggregate::kMean}) {
    const auto interval = BootstrapInterval(std::vector<double>(20, 0.1), aggregate, 1, "x");
    EXPECT_EQ(interval->low, 0.1);
    EXPECT_EQ(interval->high, 0.1);
    EXPECT_EQ(interval->kind, IntervalKind::kPercentile);
  }
}

TEST(BootstrapInterval, SurvivesTies) {
  const std::vector<double> ties = {0, 0, 0, 0, 0, 0, 0, 5};
  const auto median = BootstrapInterval(ties, Aggregate::kMedian, 1, "x");
  EXPECT_EQ(median->low, 0);
  EXPECT_LE(median->high, 5);
  const auto mean = BootstrapInterval(ties, Aggregate::kMean, 1, "x");
  EXPECT_EQ(mean->kind, IntervalKind::kBca);
  EXPECT_LE(mean->low, 0.625);
  EXPECT_GT(mean->high, 0.625);
}

/// The reference resamples and sorts; the code counts instead.
TEST(BootstrapInterval, DrawsTheMediansThatAPlainBootstrapDraws) {
  for (int n : {11, 12, 130}) {
    RandomStream dice({.suite_seed = 3, .scenario = "t", .trial = n}, "sample");
    std::vector<double> values(n);
    for (double& value : values) value = dice.Normal(10, 2);
    const auto median = [](std::span<const double> sample) { return Quantile(sample, 0.5); };
    auto replicates = Replicates(values, 1999, median);
    const Interval plain = BcaInterval(replicates, median(values), Jackknife(values, median));
    const auto ours = BootstrapInterval(values, Aggregate::kMedian, 1, "x");
    const double spread = plain.high - plain.low;
    EXPECT_NEAR(ours->low, plain.low, 0.15 * spread) << n;
    EXPECT_NEAR(ours->high, plain.high, 0.15 * spread) << n;
  }
}

/// Bit for bit, the interval equals the one from the medians of resamples that this test draws itself with the same
/// random numbers, even if some of these medians are far from the sample's median.
TEST(BootstrapInterval, HasTheMediansOfItsOwnDraws) {
  std::vector<int> sizes = {6, 7, 1000, 4001};
  for (int n = 20; n < 100; ++n) sizes.push_back(n);
  for (const int n : sizes) {
    RandomStream sample({.suite_seed = 3, .scenario = "t", .trial = n}, "sample");
    std::vector<double> values(n);
    for (double& value : values) value = sample.Normal(10, 2);
    std::ranges::sort(values);
    RandomStream dice({.suite_seed = 1, .scenario = "bootstrap", .trial = 0}, "x");
    std::vector<double> replicates;
    for (int r = 0; r < 1999; ++r) {
      std::vector<double> drawn;
      for (int i = 0; i < n; i += 2) {
        const std::uint64_t bits = dice.Bits(), count = values.size();
        drawn.push_back(values[((bits & 0xffffffffu) * count) >> 32]);
        if (i + 1 < n) drawn.push_back(values[((bits >> 32) * count) >> 32]);
      }
      replicates.push_back(Median(std::move(drawn)));
    }
    const auto median = [](std::span<const double> some) { return Quantile(some, 0.5); };
    const Interval plain = BcaInterval(replicates, median(values), Jackknife(values, median));
    const auto ours = BootstrapInterval(values, Aggregate::kMedian, 1, "x");
    EXPECT_EQ(ours->low, plain.low) << n;
    EXPECT_EQ(ours->high, plain.high) << n;
  }
}

TEST(BootstrapInterval, AgreesWithTheNormalTheoryOfTheMean) {
  RandomStream dice({.suite_seed = 3, .scenario = "t", .trial = 0}, "sample");
  std::vector<double> values(400);
  for (double& value : values) value = dice.Normal(10, 2);
  const double mean = Mean(values);
  const double standard_error = std::sqrt(PlugInVariance(values) / 399);
  const auto interval = BootstrapInterval(values, Aggregate::kMean, 1, "x");
  EXPECT_NEAR(interval->low, mean - 1.96 * standard_error, 0.15 * standard_error);
  EXPECT_NEAR(interval->high, mean + 1.96 * standard_error, 0.15 * standard_error);
}

/// Returns the share of samples whose interval contains the true value.
double Coverage(Aggregate aggregate, int n, double truth, const std::function<double(RandomStream&)>& draw) {
  int covered = 0;
  const int experiments = 400;
  for (int i = 0; i < experiments; ++i) {
    RandomStream dice({.suite_seed = 5, .scenario = "coverage", .trial = i}, "sample");
    std::vector<double> values(n);
    for (double& value : values) value = draw(dice);
    const auto interval = BootstrapInterval(values, aggregate, 9, "x");
    covered += interval->low <= truth && truth <= interval->high;
  }
  return static_cast<double>(covered) / experiments;
}

TEST(BootstrapInterval, CoversTheTruthAboutNineteenTimesOfTwenty) {
  // The standard error of 400 experiments at 95 % is 1.1 points.
  const auto normal = [](RandomStream& dice) { return dice.Normal(); };
  EXPECT_NEAR(Coverage(Aggregate::kMedian, 40, 0, normal), 0.95, 0.035);
  EXPECT_NEAR(Coverage(Aggregate::kMean, 40, 0, normal), 0.95, 0.035);
  const auto skewed = [](RandomStream& dice) { return -std::log(1 - dice.Uniform()); };
  EXPECT_NEAR(Coverage(Aggregate::kMean, 40, 1, skewed), 0.935, 0.035);
  // A dozen values determine the tails poorly: their intervals are known to cover less.
  EXPECT_GT(Coverage(Aggregate::kMedian, 12, 0, normal), 0.90);
  // The control: a wrong true value, half a standard error off.
  EXPECT_LT(Coverage(Aggregate::kMean, 40, 0.5, normal), 0.5);
}

TEST(BootstrapInterval, ThrowsDiceOfItsPurposeOnlyWhateverTheOrder) {
  const std::vector<double> values = {1.3, 5.2, 2.6, 8.1, 3.7, 9.4, 4.9, 7.5},
                            shuffled = {9.4, 1.3, 7.5, 2.6, 8.1, 3.7, 5.2, 4.9};
  const auto a = BootstrapInterval(values, Aggregate::kMean, 1, "x");
  const auto again = BootstrapInterval(shuffled, Aggregate::kMean, 1, "x");
  EXPECT_EQ(a->low, again->low);
  EXPECT_EQ(a->high, again->high);
  const auto other = BootstrapInterval(values, Aggregate::kMean, 2, "x");
  EXPECT_TRUE(other->low != a->low || other->high != a->high);
}

TEST(BootstrapInterval, OfVeryManyValuesIsAClosedFormThatSaysTheSame) {
  RandomStream dice({.suite_seed = 5, .scenario = "many", .trial = 0}, "x");
  std::vector<double> values(kMaxResampled);
  for (double& value : values) value = std::exp(dice.Normal());
  for (Aggregate aggregate : {Aggregate::kMedian, Aggregate::kMean}) {
    const Interval resampled = *BootstrapInterval(values, aggregate, 1, "x");
    std::vector<double> more = values;
    more.push_back(1);
    const Interval closed = *BootstrapInterval(more, aggregate, 1, "x");
    EXPECT_NE(closed.kind, resampled.kind);
    const double width = resampled.high - resampled.low;
    EXPECT_NEAR(closed.low, resampled.low, 0.1 * width);
    EXPECT_NEAR(closed.high, resampled.high, 0.1 * width);
  }
}

void ExpectSame(const Interval& a, const Interval& b) {
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_EQ(a.kind, b.kind);
}

TEST(BootstrapMedianAndMean, AreThoseThatEachAloneWouldBe) {
  RandomStream dice({.suite_seed = 6, .scenario = "both", .trial = 0}, "x");
  for (int n : {6, 7, 40, 129, kMaxResampled + 1}) {
    std::vector<double> values(static_cast<std::size_t>(n));
    for (double& value : values) value = std::exp(dice.Normal());
    const auto both = BootstrapMedianAndMean(values, 4, "x", 0.9);
    ExpectSame(both->median, *BootstrapInterval(values, Aggregate::kMedian, 4, "x", 0.9));
    ExpectSame(both->mean, *BootstrapInterval(values, Aggregate::kMean, 4, "x", 0.9));
  }
  const auto flat = BootstrapMedianAndMean(std::vector<double>(9, 2.5), 4, "x");
  EXPECT_EQ(flat->median.low, 2.5);
  EXPECT_EQ(flat->mean.high, 2.5);
  EXPECT_FALSE(BootstrapMedianAndMean(std::vector<double>{1, 2, 3, 4, 5}, 4, "x"));
}

}  // namespace
}  // namespace etude
