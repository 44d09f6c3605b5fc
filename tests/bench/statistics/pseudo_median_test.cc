#include "bench/statistics/pseudo_median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

std::vector<double> WalshAveragesOf(const std::vector<double>& values) {
  std::vector<double> averages;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = i; j < values.size(); ++j) averages.push_back((values[i] + values[j]) / 2);
  }
  std::sort(averages.begin(), averages.end());
  return averages;
}

/// Returns P(W ≤ w) of the signed-rank statistic of `n` values, by adding one rank at a time to its distribution.
double SignedRankCdf(int n, int w) {
  std::vector<double> chances = {1};
  for (int rank = 1; rank <= n; ++rank) {
    std::vector<double> next(chances.size() + static_cast<std::size_t>(rank));
    for (std::size_t sum = 0; sum < chances.size(); ++sum) {
      next[sum] += chances[sum] / 2;
      next[sum + static_cast<std::size_t>(rank)] += chances[sum] / 2;
    }
    chances = std::move(next);
  }
  double sum = 0;
  for (int i = 0; i <= w; ++i) sum += chances[static_cast<std::size_t>(i)];
  return sum;
}

TEST(PseudoMedianOf, AgreesWithHollanderAndWolfe) {
  // Hollander & Wolfe (1973), table 3.1, Hamilton's depression scale: −0.46, and −0.786 to −0.010 at 96.1 %.
  const PseudoMedian found =
      PseudoMedianOf(std::vector{0.878 - 1.83, 0.647 - 0.50, 0.598 - 1.62, 2.05 - 2.48, 1.06 - 1.68, 1.29 - 1.88,
                                 1.06 - 1.55, 3.14 - 3.06, 1.29 - 1.30});
  EXPECT_NEAR(found.value, -0.46, 1e-9);
  EXPECT_NEAR(found.interval->first, -0.786, 1e-9);
  EXPECT_NEAR(found.interval->second, -0.010, 1e-9);
}

TEST(PseudoMedianOf, IsTheMiddleOfAllWalshAverages) {
  RandomStream dice({.suite_seed = 1, .scenario = "walsh", .trial = 0}, "x");
  for (int n : {1, 2, 3, 5, 6, 7, 8, 9, 12, 21, 33, 50, 51, 66}) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(n % 3 == 0 ? std::round(dice.Normal(0, 2)) : dice.Normal(0.3, 1));
    const std::vector<double> averages = WalshAveragesOf(values);
    const std::size_t count = averages.size();
    const PseudoMedian found = PseudoMedianOf(values);
    EXPECT_DOUBLE_EQ(found.value, (averages[(count - 1) / 2] + averages[count / 2]) / 2) << n;
    ASSERT_EQ(found.interval.has_value(), n >= 6) << n;
    if (n < 6) continue;
    // The largest rank whose tail is at most 2.5 %. Above 50 values the code approximates this rank.
    int rank = n * n / 5 - n;
    while (rank > 0 && SignedRankCdf(n, rank) > 0.025) --rank;
    while (SignedRankCdf(n, rank) <= 0.025) ++rank;
    const auto at = static_cast<std::size_t>(rank - 1);
    if (n <= 50) {
      EXPECT_EQ(found.interval->first, averages[at]) << n;
      EXPECT_EQ(found.interval->second, averages[count - 1 - at]) << n;
    } else {
      EXPECT_GE(found.interval->first, averages[at - 2]) << n;
      EXPECT_LE(found.interval->first, averages[at + 2]) << n;
      EXPECT_LE(found.interval->second, averages[count + 1 - at]) << n;
      EXPECT_GE(found.interval->second, averages[count - 3 - at]) << n;
    }
  }
}

TEST(PseudoMedianOf, IsNotMovedByOneValueFarOff) {
  std::vector<double> values = {-3, -2, -1, 0, 0, 1, 2, 3, 4, 5, 6, 7};
  const PseudoMedian found = PseudoMedianOf(values);
  values.back() = 7e9;
  const PseudoMedian moved = PseudoMedianOf(values);
  EXPECT_NEAR(moved.value, found.value, 0.5);
  EXPECT_LT(moved.interval->second, 7);
  EXPECT_EQ(PseudoMedianOf(std::vector<double>(8, 0.0)).interval, std::pair(0.0, 0.0));
  EXPECT_EQ(PseudoMedianOf(std::vector{-4.0}).value, -4);
}

}  // namespace
}  // namespace etude
