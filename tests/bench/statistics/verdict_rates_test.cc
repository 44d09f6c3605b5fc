#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "bench/statistics/compare.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

using Draw = std::function<double(RandomStream&)>;

/// Returns how many of 200 comparisons without a true difference call one method better or worse (docs/results.md).
int Claims(Aggregate aggregate, int pairs, const Draw& difference) {
  MetricInfo metric = *FindMetric("position_error_cm");
  metric.aggregate = aggregate;
  metric.practical = 1;
  int claims = 0;
  for (int sample = 0; sample < 200; ++sample) {
    RandomStream dice({.suite_seed = 7, .scenario = "nothing to find", .trial = sample}, "x");
    std::vector<Pair> drawn;
    for (int i = 0; i < pairs; ++i) drawn.push_back({0, difference(dice)});
    const Verdict verdict = ComparePaired(drawn, metric, sample, "x").verdict;
    claims += verdict == Verdict::kBetter || verdict == Verdict::kWorse;
  }
  return claims;
}

double Normal(RandomStream& dice) { return dice.Normal(0, 3); }

TEST(ComparePaired, SeldomFindsWhatIsNotThere) {
  EXPECT_LE(Claims(Aggregate::kMedian, 12, Normal), 16);
  EXPECT_LE(Claims(Aggregate::kMean, 12, Normal), 18);
  // The control: there is a difference.
  EXPECT_GE(Claims(Aggregate::kMedian, 12, [](RandomStream& dice) { return dice.Normal(6, 3); }), 190);
}

TEST(ComparePaired, OfSkewedDifferencesTrustsTheMedianMoreThanTheMean) {
  const Draw median_zero = [](RandomStream& dice) { return 3 * (std::exp(dice.Normal()) - 1); };
  const Draw mean_zero = [](RandomStream& dice) { return 3 * (std::exp(dice.Normal()) - std::exp(0.5)); };
  EXPECT_LE(Claims(Aggregate::kMedian, 12, median_zero), 20);
  EXPECT_GE(Claims(Aggregate::kMean, 8, mean_zero), 22);  // the weakness that docs/results.md warns of
}

}  // namespace
}  // namespace etude
