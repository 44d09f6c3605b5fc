#include "bench/statistics/beyond.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "bench/statistics/distributions.h"
#include "bench/statistics/interval.h"
#include "bench/statistics/paired_tests.h"
#include "bench/statistics/pseudo_median.h"

namespace etude {
namespace {

/// For each unit, the sum of its worlds' differences and the number of its worlds; and the sum over all worlds.
struct UnitSums {
  std::vector<double> sums;
  std::vector<int> worlds;
  double total = 0;
};

UnitSums SumUnits(const UnitSample& sample) {
  UnitSums found{std::vector<double>(sample.names.size()), std::vector<int>(sample.names.size())};
  for (std::size_t i = 0; i < sample.differences.size(); ++i) {
    found.total += sample.differences[i];
    for (int unit : sample.units[i]) {
      found.sums[static_cast<std::size_t>(unit)] += sample.differences[i];
      ++found.worlds[static_cast<std::size_t>(unit)];
    }
  }
  return found;
}

/// Returns the indices of the units that have a world, sorted by name.
std::vector<std::size_t> OrderOfUnits(const UnitSample& sample, const UnitSums& sums) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < sample.names.size(); ++i) {
    if (sums.worlds[i] > 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sample.names[a] < sample.names[b]; });
  return order;
}

/// Returns the standard error of an estimate from its leave-one-unit-out values (jackknife, Tukey 1958).
double JackknifeError(std::span<const LeftOut> left_out) {
  const double n = static_cast<double>(left_out.size());
  double mean = 0, squares = 0;
  for (const LeftOut& left : left_out) mean += left.difference / n;
  for (const LeftOut& left : left_out) squares += (left.difference - mean) * (left.difference - mean);
  return std::sqrt((n - 1) / n * squares);
}

/// Returns the t test of an estimate. If the standard error is zero, t is undefined; p is then the smallest value that
/// sign flips of this many units can reach.
PairedTest StudentTest(double estimate, double error, int units) {
  std::string how = "t test of units' means";
  if (estimate == 0) return {1.0, std::move(how)};
  if (error <= 1e-12 * std::abs(estimate)) return {SmallestP(units), std::move(how)};
  return {KeepThirtyBits(StudentTwoSided(estimate / error, units - 1)), std::move(how)};
}

/// Returns the confidence interval of the mean of values that are −1, 0 or 1.
std::pair<double, double> ShareInterval(std::span<const double> values) {
  const auto gained = std::ranges::count(values, 1.0), lost = std::ranges::count(values, -1.0);
  const Interval interval =
      PairedShareInterval(static_cast<int>(gained), static_cast<int>(lost), static_cast<int>(values.size()));
  return {interval.low, interval.high};
}

/// Returns true if the interval lies on one side of zero. One end may be zero if the estimate is not: units without a
/// difference make many Walsh averages zero, which the signed-rank test takes into account.
bool IsOnOneSide(const Beyond& beyond) {
  return (*beyond.low >= 0 && *beyond.difference > 0) || (*beyond.high <= 0 && *beyond.difference < 0);
}

/// Returns true if the mean has the sign of the pseudo-median. If it does not, a few units outweigh the others.
bool MeanAgrees(const Beyond& beyond) { return *beyond.mean * *beyond.difference > 0; }

}  // namespace

bool UnitSample::IsOneWay() const {
  return std::all_of(units.begin(), units.end(), [](const std::vector<int>& of_world) { return of_world.size() == 1; });
}

UnitSample UnitsOf(const PairedWorlds& paired, const ConditionTable& table, const MetricInfo& metric) {
  UnitSample sample;
  sample.names = table.units;
  sample.yes_or_no = metric.reading == Reading::kYesNo;
  for (std::size_t i = 0; i < paired.pairs.size(); ++i) {
    const std::vector<int>& units = table.world_units[static_cast<std::size_t>(paired.trials[i])];
    if (units.empty()) continue;
    sample.differences.push_back(DifferenceOf(paired.pairs[i], metric));
    sample.units.push_back(units);
  }
  return sample;
}

Beyond MeasureBeyond(const UnitSample& sample, int comparisons) {
  Beyond beyond;
  // Compute the mean over units, or over worlds if a world has several units.
  const UnitSums sums = SumUnits(sample);
  const std::vector<std::size_t> order = OrderOfUnits(sample, sums);
  beyond.units = static_cast<int>(order.size());
  if (order.empty()) return beyond;
  std::vector<double> means;
  for (std::size_t unit : order) means.push_back(KeepThirtyBits(sums.sums[unit] / sums.worlds[unit]));
  beyond.differing = static_cast<int>(std::count_if(means.begin(), means.end(), [](double mean) { return mean != 0; }));
  const bool one_way = sample.IsOneWay();
  const double n = static_cast<double>(means.size()), worlds = static_cast<double>(sample.differences.size());
  const double sum_of_means = std::accumulate(means.begin(), means.end(), 0.0);
  const double mean = one_way ? sum_of_means / n : sums.total / worlds;
  beyond.mean = mean;
  // For each unit, compute the mean without all worlds of that unit.
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double rest = one_way ? n - 1 : worlds - sums.worlds[order[i]];
    if (rest == 0) continue;  // if all worlds share this unit, no world is left
    const double sum = one_way ? sum_of_means - means[i] : sums.total - sums.sums[order[i]];
    beyond.left_out.push_back({sample.names[order[i]], sum / rest});
  }
  // Compute one value per unit (its mean, or the jackknife's pseudo-value), and the pseudo-median of these values.
  std::vector<double> values = means;
  if (!one_way && beyond.left_out.size() == means.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = KeepThirtyBits(n * mean - (n - 1) * beyond.left_out[i].difference);
    }
  }
  // Values that are all −1, 0 or 1 are treated as those of a yes-or-no metric. If all are zero, the metric itself must
  // be yes-or-no, because the values of an amount may also all be zero, and an amount must not get a share's interval.
  const bool is_yes_or_no = (sample.yes_or_no || beyond.differing > 0) && std::ranges::all_of(values, [](double value) {
                              return std::abs(value) == 1 || value == 0;
                            });
  const PseudoMedian centre = PseudoMedianOf(values);
  beyond.difference = is_yes_or_no ? mean : centre.value;
  if (beyond.units < kMinUnits || beyond.left_out.size() < means.size()) return beyond;
  std::tie(beyond.low, beyond.high) = is_yes_or_no ? ShareInterval(values) : *centre.interval;
  // Compute the interval of the mean by Student's t from the jackknife's standard error.
  const double error = JackknifeError(beyond.left_out);
  const double half = StudentQuantile(1 - kAlpha / 2, beyond.units - 1) * error;
  beyond.mean_low = KeepThirtyBits(mean - half);
  beyond.mean_high = KeepThirtyBits(mean + half);
  // Choose the test by the numbers of units and comparisons, never by the result.
  if (SmallestP(beyond.units) * comparisons <= kAlpha) {
    // If all values have the same size, all ranks are equal, and the signed-rank test is the sign test.
    beyond.test = SignedRankTest(values);
    beyond.test.how = "signed ranks of units, " + beyond.test.how;
  } else {
    beyond.test = StudentTest(mean, error, beyond.units);
  }
  return beyond;
}

std::optional<Verdict> VerdictBeyond(const Beyond& beyond, const MetricInfo& metric) {
  if (!beyond.low || !beyond.p_holm) return std::nullopt;
  if (!beyond.not_alike.empty()) return Verdict::kUndecided;
  // "No difference" requires that the intervals of the pseudo-median and of the mean lie within ± threshold, and that
  // enough units differ.
  const auto is_within = [&](double low, double high) { return low >= -metric.practical && high <= metric.practical; };
  if (is_within(*beyond.low, *beyond.high)) {
    const bool holds = is_within(*beyond.mean_low, *beyond.mean_high) && beyond.differing >= kMinUnits;
    return holds ? Verdict::kNoDifference : Verdict::kUndecided;
  }
  // "Better" and "worse" require an interval on one side of zero, a mean of the same sign, p_holm ≤ kAlpha, and a
  // difference of at least the threshold.
  if (!IsOnOneSide(beyond) || !MeanAgrees(beyond) || *beyond.p_holm > kAlpha ||
      std::abs(*beyond.difference) < metric.practical || metric.direction == Direction::kNeither) {
    return Verdict::kUndecided;
  }
  const bool lower = *beyond.difference < 0;
  return lower == (metric.direction == Direction::kLowerIsBetter) ? Verdict::kBetter : Verdict::kWorse;
}

std::string WhyOpenBeyond(const Beyond& beyond, const MetricInfo& metric, SamplingUnit unit, int comparisons) {
  if (beyond.units < kMinUnits) {
    return fmt::format("{}: no verdict for others; at least {} are needed", CountUnits(beyond.units, unit), kMinUnits);
  }
  if (!beyond.low) return "all worlds show the same clip: no verdict for other clips";
  if (beyond.verdict != Verdict::kUndecided) return "";
  if (!beyond.not_alike.empty()) return beyond.not_alike;
  const bool within = *beyond.low >= -metric.practical && *beyond.high <= metric.practical;
  if (within && beyond.differing < kMinUnits) {
    return fmt::format("only {} of {} differ; rare differences may be missing among them", beyond.differing,
                       CountUnits(beyond.units, unit));
  }
  if (within) return "the pseudo-median is too small to matter, but the mean may be large enough";
  if (!IsOnOneSide(beyond)) return "the interval contains zero and differences that matter";
  if (!MeanAgrees(beyond)) return "the pseudo-median and the mean differ in sign: a few units outweigh the others";
  if (*beyond.p_holm > kAlpha) {
    return *beyond.test.p > kAlpha ? "the interval excludes zero, but the test does not confirm it"
                                   : fmt::format("p = {:.2g} is significant alone, but not among {} comparisons (Holm)",
                                                 *beyond.test.p, comparisons);
  }
  if (std::abs(*beyond.difference) < metric.practical)
    return "there is a difference, but it is undecided whether it is large enough to matter";
  return "there is a difference, but neither direction is better";
}

}  // namespace etude
