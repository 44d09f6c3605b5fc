#include "bench/statistics/bootstrap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/statistics/distributions.h"
#include "engine/base/order_statistics.h"
#include "sim/random/philox_lanes.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// The number of resamples. It is one less than a round number, so that the 2.5 % and 97.5 % quantiles are replicates.
constexpr std::size_t kResamples = 1999;

/// Returns the median of sorted values without the value at index `without`.
double MedianWithout(std::span<const double> sorted, std::size_t without) {
  const auto at = [&](std::size_t i) { return sorted[i < without ? i : i + 1]; };
  const std::size_t count = sorted.size() - 1;
  return 0.5 * (at((count - 1) / 2) + at(count / 2));
}

/// Returns the jackknife values: the aggregate with each value left out in turn.
std::vector<double> Jackknife(std::span<const double> sorted, Aggregate aggregate) {
  std::vector<double> values(sorted.size());
  const double n = static_cast<double>(sorted.size()), mean = Mean(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    values[i] = aggregate == Aggregate::kMedian ? MedianWithout(sorted, i) : mean + (mean - sorted[i]) / (n - 1);
  }
  return values;
}

/// Finds the medians of resamples of sorted values. A random 32-bit number r draws the value at index
/// ⌊r · count / 2³²⌋.
class DrawnMedian {
 public:
  explicit DrawnMedian(std::span<const double> sorted)
      : sorted_(sorted),
        lower_((sorted.size() - 1) / 2),
        upper_(sorted.size() / 2),
        near_(sorted.size() + kHalvesSlack) {
    // The ranks of the middle draws are nearly always within three standard errors of the middle. A standard error is
    // √count / 2 ranks.
    const auto reach = static_cast<std::size_t>(1.5 * std::sqrt(static_cast<double>(sorted.size())));
    low_ = static_cast<std::uint32_t>(FirstDrawing(lower_ - std::min(lower_, reach)));
    last_ = static_cast<std::uint32_t>(FirstDrawing(std::min(sorted.size(), upper_ + 1 + reach)) - 1);
  }

  /// Returns the median of a resample. Each 64-bit number of `drawn` holds two 32-bit numbers, which draw one value
  /// each. Compares only the draws near the middle, unless the median is not among them.
  double Of(const std::uint64_t* drawn) {
    HalvesWithin found = FindHalvesWithin(drawn, sorted_.size(), low_, last_, near_.data());
    if (lower_ < found.below || upper_ >= found.below + found.within) {
      // The median is not among these draws, so compare all draws.
      found = FindHalvesWithin(drawn, sorted_.size(), 0, ~std::uint32_t{0}, near_.data());
    }
    const auto end = near_.begin() + static_cast<std::ptrdiff_t>(found.within);
    const auto lower = near_.begin() + static_cast<std::ptrdiff_t>(lower_ - found.below);
    std::nth_element(near_.begin(), lower, end);
    const std::uint32_t above = upper_ == lower_ ? *lower : *std::min_element(lower + 1, end);
    return 0.5 * (ValueOf(*lower) + ValueOf(above));
  }

 private:
  /// Returns the smallest 32-bit number that draws `index` or a larger index.
  std::uint64_t FirstDrawing(std::size_t index) const { return ((index << 32) + sorted_.size() - 1) / sorted_.size(); }
  double ValueOf(std::uint64_t number) const { return sorted_[(number * sorted_.size()) >> 32]; }

  std::span<const double> sorted_;
  std::size_t lower_, upper_;  ///< the ranks of the two middle draws
  std::vector<std::uint32_t> near_;
  std::uint32_t low_ = 0, last_ = 0;
};

/// Fills `means` and `medians` with the aggregates of resamples. Each span has kResamples entries, or is empty if the
/// aggregate is not needed. Each resample draws as many indices as there are values, two from each 64 random bits. The
/// probability of an index is higher than that of another by at most a factor of 1 + count / 2³². Four resamples are
/// summed side by side, because each addition to a single sum would have to wait for the previous one.
void Resample(std::span<const double> sorted, RandomStream& dice, std::span<double> means, std::span<double> medians) {
  constexpr std::size_t kTogether = 4;
  const std::size_t count = sorted.size(), words = (count + 1) / 2, pairs = count / 2;
  const auto first = [&](std::uint64_t bits) { return ((bits & 0xffffffffu) * count) >> 32; };
  const auto second = [&](std::uint64_t bits) { return ((bits >> 32) * count) >> 32; };
  std::vector<std::uint64_t> bits(kTogether * words);
  DrawnMedian median(sorted);
  for (std::size_t done = 0; done < kResamples; done += kTogether) {
    const std::size_t together = std::min(kTogether, kResamples - done);
    dice.FillBits(std::span(bits).first(together * words));
    const std::uint64_t* const drawn = bits.data();
    // Compute the means of several resamples at once.
    if (!means.empty()) {
      std::array<double, kTogether> sums{};
      for (std::size_t i = 0; i < words; ++i) {
        for (std::size_t k = 0; k < kTogether; ++k) {
          sums[k] += sorted[first(drawn[k * words + i])];
          if (i < pairs) sums[k] += sorted[second(drawn[k * words + i])];
        }
      }
      for (std::size_t k = 0; k < together; ++k) means[done + k] = sums[k] / static_cast<double>(count);
    }
    for (std::size_t k = 0; k < together && !medians.empty(); ++k) medians[done + k] = median.Of(drawn + k * words);
  }
}

/// Returns the BCa-corrected level of one end of the interval; nothing if the correction is undefined.
std::optional<double> BcaLevel(double level, double bias, double acceleration) {
  const double z = bias + NormalQuantile(level);
  const double stretch = 1 - acceleration * z;
  if (stretch <= 0) return std::nullopt;
  return NormalCdf(bias + z / stretch);
}

/// Returns the acceleration: a sixth of the jackknife's skewness (Efron 1987, equation 7.3 with the jackknife's
/// influence values). Returns nothing if the jackknife values do not differ.
std::optional<double> Acceleration(std::span<const double> jackknife) {
  const double mean = Mean(jackknife);
  double squares = 0, cubes = 0, largest = 0;
  for (double value : jackknife) {
    const double pull = mean - value;
    squares += pull * pull;
    cubes += pull * pull * pull;
    largest = std::max(largest, std::abs(value));
  }
  // The jackknife values of a constant sample differ by rounding alone; that counts as no difference.
  const double noise = 1e-12 * largest;
  if (squares <= noise * noise * static_cast<double>(jackknife.size())) return std::nullopt;
  return cubes / (6 * squares * std::sqrt(squares));
}

/// Returns the replicate at a level. Its rank is level · (number of replicates + 1), rounded to an integer, so the last
/// bits of `level` have no effect.
double AtLevel(std::span<const double> sorted, double level) {
  const double rank = std::round(level * static_cast<double>(sorted.size() + 1));
  return sorted[static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(sorted.size()))) - 1];
}

/// Returns the interval of the median from order statistics. The number of values below the median has a binomial
/// distribution, which is approximated here by a normal one.
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

/// Returns the interval of a sample that needs no resampling, because all values are equal or there are too many.
/// Returns nullopt for other samples.
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
  // The share of replicates below the estimate gives the bias. Replicates that equal the estimate count half.
  std::sort(replicates.begin(), replicates.end());
  const auto [first, last] = std::equal_range(replicates.begin(), replicates.end(), estimate);
  const double below = static_cast<double>(first - replicates.begin()) + 0.5 * static_cast<double>(last - first);
  const double share_below = below / static_cast<double>(replicates.size());
  const double tail = (1 - confidence) / 2;
  const Interval percentile{AtLevel(replicates, tail), AtLevel(replicates, 1 - tail), IntervalKind::kPercentile};
  if (share_below <= 0 || share_below >= 1) return percentile;
  // Correct both ends of the interval for bias and acceleration.
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
  const bool is_median = aggregate == Aggregate::kMedian;
  Resample(sorted, dice, is_median ? std::span<double>() : replicates, is_median ? replicates : std::span<double>());
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
  // Draw one set of resamples for both aggregates, in the order in which BootstrapInterval draws them.
  std::vector<double> medians(kResamples), means(kResamples);
  Resample(sorted, dice, means, medians);
  const auto interval = [&](std::vector<double>& replicates, Aggregate aggregate) {
    return BcaInterval(replicates, AggregateOf(sorted, aggregate), Jackknife(sorted, aggregate), confidence);
  };
  return MedianAndMean{interval(medians, Aggregate::kMedian), interval(means, Aggregate::kMean)};
}

}  // namespace etude
