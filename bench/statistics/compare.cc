#include "bench/statistics/compare.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "bench/statistics/paired_tests.h"

namespace etude {
namespace {

/// Returns the interval of the difference of two shares. `differences` are −1, 0 or 1.
Interval ShareInterval(std::span<const double> differences, double confidence) {
  const auto gained = std::count(differences.begin(), differences.end(), 1.0);
  const auto lost = std::count(differences.begin(), differences.end(), -1.0);
  return PairedShareInterval(static_cast<int>(gained), static_cast<int>(lost), static_cast<int>(differences.size()),
                             confidence);
}

/// Returns the share of the pairs in which the method has the better value. Ties count half.
double ShareBetter(std::span<const double> differences, double sign) {
  double better = 0;
  for (double difference : differences) better += difference == 0 ? 0.5 : (sign * difference > 0 ? 1.0 : 0.0);
  return better / static_cast<double>(differences.size());
}

/// Computes the intervals of the differences' median and mean. If the metric's aggregate is the mean, the interval of
/// the median is left empty.
MedianAndMean IntervalsOf(std::span<const Pair> pairs, std::span<const double> differences, const MetricInfo& metric,
                          std::uint64_t seed, const std::string& purpose, double confidence) {
  if (metric.aggregate == Aggregate::kMedian) {
    return *BootstrapMedianAndMean(differences, seed, purpose, confidence);
  }
  if (AreShares(pairs, metric)) return {{}, ShareInterval(differences, confidence)};
  return {{}, *BootstrapInterval(differences, Aggregate::kMean, seed, purpose, confidence)};
}

}  // namespace

double DifferenceOf(const Pair& pair, const MetricInfo& metric) {
  const double difference = pair.method - pair.baseline;
  return std::abs(difference) <= 1e-9 * metric.practical ? 0 : KeepThirtyBits(difference);
}

bool AreShares(std::span<const Pair> pairs, const MetricInfo& metric) {
  const auto is_share = [](double value) { return value == 0 || value == 1; };
  return metric.reading != Reading::kAmount &&
         std::ranges::all_of(pairs, [&](const Pair& pair) { return is_share(pair.baseline) && is_share(pair.method); });
}

Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose, double confidence) {
  Comparison result;
  result.metric = metric.id;
  result.pairs = static_cast<int>(pairs.size());
  if (pairs.empty()) return result;
  // Compute the paired differences, and count those that are not zero.
  std::vector<double> differences;
  for (const Pair& pair : pairs) {
    differences.push_back(DifferenceOf(pair, metric));
    result.differing += differences.back() != 0;
  }
  // Compute the estimates with their intervals.
  result.difference = AggregateOf(differences, metric.aggregate);
  result.mean = Mean(differences);
  if (result.pairs >= kMinSample) {
    const MedianAndMean intervals = IntervalsOf(pairs, differences, metric, seed, purpose, confidence);
    const Interval& own = metric.aggregate == Aggregate::kMedian ? intervals.median : intervals.mean;
    result.mean_low = intervals.mean.low;
    result.mean_high = intervals.mean.high;
    result.ci_low = own.low;
    result.ci_high = own.high;
    result.interval = own.kind;
  }
  // Compute the signed-rank test, the sign-flip test and the effect size, and judge the comparison as if it were the
  // only one.
  result.signed_rank = SignedRankTest(differences);
  result.sign_flip = SignFlipTest(differences, metric.aggregate, seed, purpose);
  // Larger values count as better if the metric has no direction.
  const double sign = metric.direction == Direction::kLowerIsBetter ? -1 : 1;
  result.share_better = ShareBetter(differences, sign);
  for (double difference : differences) {
    if (difference == 0 || std::abs(difference) < metric.practical) continue;
    ++(sign * difference > 0 ? result.better : result.worse);
  }
  result.effect_size = RankBiserial(differences) * sign + 0.0;
  result.p_holm = DecidingP(result, metric);
  result.verdict = VerdictOf(result, metric, confidence);
  return result;
}

std::optional<double> DecidingP(const Comparison& comparison, const MetricInfo& metric) {
  return metric.aggregate == Aggregate::kMedian ? comparison.signed_rank.p : comparison.sign_flip.p;
}

bool SeesTooFewDiffer(const Comparison& comparison, const MetricInfo& metric) {
  return metric.aggregate == Aggregate::kMean && comparison.interval != IntervalKind::kAdjustedWald &&
         comparison.differing < kMinSample;
}

Verdict VerdictOf(const Comparison& comparison, const MetricInfo& metric, double confidence) {
  if (!comparison.not_alike.empty() || !comparison.ci_low || !comparison.p_holm) return Verdict::kUndecided;
  const double low = *comparison.ci_low, high = *comparison.ci_high, difference = *comparison.difference;
  // "No difference" requires that the intervals of the aggregate and of the mean lie within ± threshold.
  const auto is_within = [&](double from, double to) { return from >= -metric.practical && to <= metric.practical; };
  if (is_within(low, high)) {
    const bool holds = is_within(*comparison.mean_low, *comparison.mean_high) && !SeesTooFewDiffer(comparison, metric);
    return holds ? Verdict::kNoDifference : Verdict::kUndecided;
  }
  // Otherwise, "better" and "worse" require the interval, the test and the threshold.
  const bool beyond_zero = low > 0 || high < 0;
  const bool significant = *comparison.p_holm <= 1 - confidence;
  if (!beyond_zero || !significant || std::abs(difference) < metric.practical) return Verdict::kUndecided;
  if (metric.direction == Direction::kNeither) return Verdict::kUndecided;
  return (difference < 0) == (metric.direction == Direction::kLowerIsBetter) ? Verdict::kBetter : Verdict::kWorse;
}

Verdict JudgeBothWays(Comparison& comparison, const std::optional<Comparison>& with_failures, const MetricInfo& metric,
                      double confidence) {
  Verdict of_pairs = VerdictOf(comparison, metric, confidence);
  comparison.verdict = of_pairs;
  if (!with_failures) return of_pairs;
  comparison.p_holm = with_failures->p_holm;
  const Verdict with_their_p = VerdictOf(comparison, metric, confidence);
  if (of_pairs == Verdict::kUndecided) of_pairs = with_their_p;
  const bool agree = with_their_p == VerdictOf(*with_failures, metric, confidence);
  comparison.verdict = agree ? with_their_p : Verdict::kUndecided;
  return of_pairs;
}

}  // namespace etude
