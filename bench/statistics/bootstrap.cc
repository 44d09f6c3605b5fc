#include "bench/statistics/bootstrap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/statistics/distributions.h"
#include "engine/base/order_statistics.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// One less than a round number, so that the 2.5 % and 97.5 % quantiles are replicates.
constexpr std::size_t kResamples = 1999;

/// Returns the median of sorted values without the one at index `without`.
double MedianWithout(std::span<const double> sorted, std::size_t without) {
  const auto at = [&](std::size_t i) { return sorted[i < without ? i : i + 1]; };
  const std::size_t count = sorted.size() - 1;
  return 0.5 * (at((count - 1) / 2) + at(count / 2));
}

/// Returns the aggregate with each value left out in turn.
std::vector<double> Jackknife(std::span<const double> sorted, Aggregate aggregate) {
  std::vector<double> values(sorted.size());
  const double n = static_cast<double>(sorted.size()), mean = Mean(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    values[i] = aggregate == Aggregate::kMedian ? MedianWithout(sorted, i) : mean + (mean - sorted[i]) / (n - 1);
  }
  return values;
}

/// Calls `use` with `count` random indices below `count`, two from each 64 random bits. No index is favoured by more
/// than count / 2³².
template <typename Use>
void DrawIndices(RandomStream& dice, std::size_t count, const Use& use) {
  std::array<std::uint64_t, 128> buffer;
  for (std::size_t left = count; left > 0;) {
    const std::span<std::uint64_t> drawn(buffer.data(), std::min(buffer.size(), (left + 1) / 2));
    dice.FillBits(drawn);
    for (const std::uint64_t bits : drawn) {
      use(((bits & 0xffffffffu) * count) >> 32);
      if (--left == 0) break;
      use(((bits >> 32) * count) >> 32);
      --left;
    }
  }
}

double ResampledMean(std::span<const double> sorted, RandomStream& dice) {
  double sum = 0;
  DrawIndices(dice, sorted.size(), [&](std::size_t index) { sum += sorted[index]; });
  return sum / static_cast<double>(sorted.size());
}

/// Returns the median of a resample in which value i occurs `counts[i]` times. Walking to the middle avoids sorting.
double MedianOfDrawn(std::span<const double> sorted, std::span<const int> counts) {
  const int low = static_cast<int>(sorted.size() - 1) / 2, high = static_cast<int>(sorted.size()) / 2;
  std::size_t index = 0;
  int passed = counts[0];
  while (passed <= low) passed += counts[++index];
  const double lower = sorted[index];
  while (passed <= high) passed += counts[++index];
  return 0.5 * (lower + sorted[index]);
}

double ResampledMedian(std::span<const double> sorted, RandomStream& dice, std::vector<int>& counts) {
  counts.assign(sorted.size(), 0);
  DrawIndices(dice, sorted.size(), [&](std::size_t index) { ++counts[index]; });
  return MedianOfDrawn(sorted, counts);
}

/// Returns the corrected level of one end of the interval; nothing where the correction is undefined.
std::optional<double> BcaLevel(double level, double bias, double acceleration) {
  const double z = bias + NormalQuantile(level);
  const double stretch = 1 - acceleration * z;
  if (stretch <= 0) return std::nullopt;
  return NormalCdf(bias + z / stretch);
}

/// Returns a sixth of the jackknife's skewness (Efron 1987, equation 7.3 with the jackknife's influence values);
/// nothing for a jackknife without spread.
std::optional<double> Acceleration(std::span<const double> jackknife) {
  const double mean = Mean(jackknife);
  double squares = 0, cubes = 0, largest = 0;
  for (double value : jackknife) {
    const double pull = mean - value;
    squares += pull * pull;
    cubes += pull * pull * pull;
    largest = std::max(largest, std::abs(value));
  }
  // Rounding alone makes the jackknife values of a constant sample differ.
  const double noise = 1e-12 * largest;
  if (squares <= noise * noise * static_cast<double>(jackknife.size())) return std::nullopt;
  return cubes / (6 * squares * std::sqrt(squares));
}

/// Returns the replicate at a level. The rank is rounded to an integer, so the last bits of `level` have no effect.
double AtLevel(std::span<const double> sorted, double level) {
  const double rank = std::round(level * static_cast<double>(sorted.size() + 1));
  return sorted[static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(sorted.size()))) - 1];
}

/// Returns the interval of the median from order statistics: the number of values below the median is binomial,
/// approximated here by a normal distribution.
Interval OrderStatisticsInterval(std::span<const double> sorted, double confidence) {
  const double n = static_cast<double>(sorted.size());
  const double below = std::floor(0.5 * n - 0.5 * std::sqrt(n) * NormalQuantile(0.5 + confidence / 2));
  const auto rank = static_cast<std::size_t>(std::max(below, 0.0));
  return {sorted[rank], sorted[sorted.size() - 1 - rank], IntervalKind::kOrderStatistics};
}

Interval StudentInterval(std::span<const double> values, double confidence) {
  const double n = static_cast<double>(values.size()), mean = Mean(values);
  double squares = 0;
  for (double value : values) squares += (value - mean) * (value - mean);
  const int freedom = static_cast<int>(values.size()) - 1;
  const double half = StudentQuantile(0.5 + confidence / 2, freedom) * std::sqrt(squares / freedom / n);
  return {KeepThirtyBits(mean - half), KeepThirtyBits(mean + half), IntervalKind::kStudent};
}

std::vector<double> Sorted(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Returns the interval of a sample whose values are all equal, or which is too large to be resampled; nullopt for
/// other samples.
std::optional<Interval> IntervalWithoutDice(std::span<const double> sorted, Aggregate aggregate, double confidence) {
  if (sorted.front() == sorted.back()) return Interval{sorted.front(), sorted.front(), IntervalKind::kPercentile};
  if (static_cast<int>(sorted.size()) <= kMaxResampled) return std::nullopt;
  return aggregate == Aggregate::kMedian ? OrderStatisticsInterval(sorted, confidence)
                                         : StudentInterval(sorted, confidence);
}

RandomStream DiceOf(std::uint64_t seed, const std::string& purpose) {
  return RandomStream({.suite_seed = seed, .scenario = "bootstrap", .trial = 0}, purpose);
}

}  // namespace

double Mean(std::span<const double> values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double AggregateOf(std::span<const double> values, Aggregate aggregate) {
  return aggregate == Aggregate::kMedian ? Quantile(values, 0.5) : Mean(values);
}

Interval BcaInterval(std::vector<double>& replicates, double estimate, std::span<const double> jackknife,
                     double confidence) {
  // The share of replicates below the estimate gives the bias; those that equal it count half.
  std::sort(replicates.begin(), replicates.end());
  const auto [first, last] = std::equal_range(replicates.begin(), replicates.end(), estimate);
  const double below = static_cast<double>(first - replicates.begin()) + 0.5 * static_cast<double>(last - first);
  const double share_below = below / static_cast<double>(replicates.size());
  const double tail = (1 - confidence) / 2;
  const Interval percentile{AtLevel(replicates, tail), AtLevel(replicates, 1 - tail), IntervalKind::kPercentile};
  if (share_below <= 0 || share_below >= 1) return percentile;
  // Correct both ends for bias and acceleration.
  const double bias = NormalQuantile(share_below);
  const auto acceleration = Acceleration(jackknife);
  if (!acceleration) return percentile;
  const auto low = BcaLevel(tail, bias, *acceleration), high = BcaLevel(1 - tail, bias, *acceleration);
  if (!low || !high) return percentile;
  return {AtLevel(replicates, *low), AtLevel(replicates, *high), IntervalKind::kBca};
}

std::optional<Interval> BootstrapInterval(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                          const std::string& purpose, double confidence) {
  if (static_cast<int>(values.size()) < kMinSample) return std::nullopt;
  const std::vector<double> sorted = Sorted(values);
  if (const auto known = IntervalWithoutDice(sorted, aggregate, confidence)) return known;
  RandomStream dice = DiceOf(seed, purpose);
  std::vector<double> replicates(kResamples);
  std::vector<int> counts;
  for (double& replicate : replicates) {
    replicate = aggregate == Aggregate::kMedian ? ResampledMedian(sorted, dice, counts) : ResampledMean(sorted, dice);
  }
  return BcaInterval(replicates, AggregateOf(sorted, aggregate), Jackknife(sorted, aggregate), confidence);
}

std::optional<MedianAndMean> BootstrapMedianAndMean(std::span<const double> values, std::uint64_t seed,
                                                    const std::string& purpose, double confidence) {
  if (static_cast<int>(values.size()) < kMinSample) return std::nullopt;
  const std::vector<double> sorted = Sorted(values);
  if (const auto median = IntervalWithoutDice(sorted, Aggregate::kMedian, confidence)) {
    return MedianAndMean{*median, *IntervalWithoutDice(sorted, Aggregate::kMean, confidence)};
  }
  RandomStream dice = DiceOf(seed, purpose);
  // Both aggregates see the same resamples, in the order in which BootstrapInterval would draw them.
  std::vector<double> medians(kResamples), means(kResamples);
  std::vector<int> counts;
  for (std::size_t i = 0; i < kResamples; ++i) {
    counts.assign(sorted.size(), 0);
    double sum = 0;
    DrawIndices(dice, sorted.size(), [&](std::size_t index) {
      ++counts[index];
      sum += sorted[index];
    });
    medians[i] = MedianOfDrawn(sorted, counts);
    means[i] = sum / static_cast<double>(sorted.size());
  }
  const auto interval = [&](std::vector<double>& replicates, Aggregate aggregate) {
    return BcaInterval(replicates, AggregateOf(sorted, aggregate), Jackknife(sorted, aggregate), confidence);
  };
  return MedianAndMean{interval(medians, Aggregate::kMedian), interval(means, Aggregate::kMean)};
}

}  // namespace etude
