#include "bench/statistics/compare.h"

#include <cmath>
#include <vector>

#include "bench/statistics/bootstrap.h"

namespace etude {
namespace {

Verdict Judge(double difference, const Interval& interval, const MetricInfo& metric) {
  const bool beyond_zero = interval.low > 0 || interval.high < 0;
  const bool negligible = interval.low >= -metric.practical && interval.high <= metric.practical;
  if (negligible || (beyond_zero && std::abs(difference) < metric.practical)) return Verdict::kNoDifference;
  if (!beyond_zero || metric.direction == Direction::kNeither) return Verdict::kInconclusive;
  const bool lower = difference < 0;
  return lower == (metric.direction == Direction::kLowerIsBetter) ? Verdict::kBetter : Verdict::kWorse;
}

}  // namespace

Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose) {
  Comparison comparison;
  comparison.metric = metric.id;
  comparison.pairs = static_cast<int>(pairs.size());
  if (pairs.empty()) return comparison;
  std::vector<double> differences;
  const double sign = metric.direction == Direction::kHigherIsBetter ? 1 : -1;
  for (const Pair& pair : pairs) {
    const double difference = pair.method - pair.baseline;
    differences.push_back(difference);
    comparison.share_better += difference == 0 ? 0.5 : (sign * difference > 0 ? 1.0 : 0.0);
  }
  comparison.share_better /= static_cast<double>(pairs.size());
  comparison.difference = AggregateOf(differences, metric.aggregate);
  if (const auto interval = BootstrapInterval(differences, metric.aggregate, seed, purpose)) {
    comparison.ci_low = interval->low;
    comparison.ci_high = interval->high;
    comparison.verdict = Judge(*comparison.difference, *interval, metric);
  }
  return comparison;
}

}  // namespace etude
