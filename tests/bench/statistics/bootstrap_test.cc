#include "bench/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

TEST(Quantile, IsNumpysDefault) {
  // numpy.quantile([3, 1, 4, 1, 5, 9, 2, 6], q)
  const std::vector<double> values = {3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_DOUBLE_EQ(Quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.95), 7.95);
  EXPECT_DOUBLE_EQ(Quantile(values, 1), 9);
  EXPECT_DOUBLE_EQ(Quantile(std::vector<double>{7}, 0.5), 7);
}

TEST(BootstrapInterval, NeedsSixValues) {
  const std::vector<double> five = {1, 2, 3, 4, 5}, six = {1, 2, 3, 4, 5, 6};
  EXPECT_FALSE(BootstrapInterval(five, Aggregate::kMedian, 1, "x"));
  EXPECT_TRUE(BootstrapInterval(six, Aggregate::kMedian, 1, "x"));
}

TEST(BootstrapInterval, AgreesWithTheNormalTheoryOfTheMean) {
  RandomStream dice({.suite_seed = 3, .scenario = "t", .trial = 0}, "sample");
  std::vector<double> values(400);
  for (double& value : values) value = dice.Normal(10, 2);
  const double mean = Mean(values);
  double squares = 0;
  for (double value : values) squares += (value - mean) * (value - mean);
  const double standard_error = std::sqrt(squares / 399 / 400);
  const auto interval = BootstrapInterval(values, Aggregate::kMean, 1, "x");
  EXPECT_NEAR(interval->low, mean - 1.96 * standard_error, 0.15 * standard_error);
  EXPECT_NEAR(interval->high, mean + 1.96 * standard_error, 0.15 * standard_error);
}

TEST(BootstrapInterval, CoversTheTrueMedianAboutNineteenTimesOfTwenty) {
  int covered = 0;
  const int experiments = 300;
  for (int i = 0; i < experiments; ++i) {
    RandomStream dice({.suite_seed = 5, .scenario = "coverage", .trial = i}, "sample");
    std::vector<double> values(40);
    for (double& value : values) value = dice.Normal();
    const auto interval = BootstrapInterval(values, Aggregate::kMedian, 9, "x");
    if (interval->low <= 0 && 0 <= interval->high) ++covered;
  }
  // The percentile interval of a median is slightly generous; binomial noise is 1.3 points.
  EXPECT_GT(covered, 0.91 * experiments);
  EXPECT_LT(covered, 0.99 * experiments);
}

TEST(BootstrapInterval, ThrowsDiceOfItsPurposeOnly) {
  const std::vector<double> values = {1, 5, 2, 8, 3, 9, 4, 7};
  const auto a = BootstrapInterval(values, Aggregate::kMean, 1, "x");
  const auto again = BootstrapInterval(values, Aggregate::kMean, 1, "x");
  EXPECT_EQ(a->low, again->low);
  EXPECT_EQ(a->high, again->high);
  const auto other = BootstrapInterval(values, Aggregate::kMean, 2, "x");
  EXPECT_TRUE(other->low != a->low || other->high != a->high);
}

}  // namespace
}  // namespace etude
