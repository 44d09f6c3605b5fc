#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/statistics/interval.h"

namespace etude {

double Mean(std::span<const double> values);

/// Median or mean, as the metric is aggregated.
double AggregateOf(std::span<const double> values, Aggregate aggregate);

/// A sample smaller than this has no interval: the sign test of five values can't reach 95 %.
constexpr int kSmallestSample = 6;

/// The bias-corrected and accelerated bootstrap interval (Efron 1987, section 3) of any statistic, from its
/// bootstrap replicates, which get sorted, its estimate, and its values with one observation left out each.
/// Replicates equal to the estimate count half on either side. Its ends are replicates. Where the correction is
/// undefined — all replicates on one side of the estimate, or a jackknife without spread — it is the percentile
/// interval (Efron 1979), and its kind says so.
Interval BcaInterval(std::vector<double>& replicates, double estimate, std::span<const double> jackknife,
                     double confidence = kConfidence);

/// A larger sample is not resampled: closed forms say the same there, and cost nothing.
constexpr int kLargestResampled = 20'000;

/// The BCa interval of the values' aggregate, from 1,999 resamples of a stream keyed by `seed` and `purpose`. It
/// depends on the values, not on their order. Nothing for fewer than kSmallestSample values; of more than
/// kLargestResampled that of order statistics of the median, Student's of the mean.
std::optional<Interval> BootstrapInterval(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                          const std::string& purpose, double confidence = kConfidence);

struct MedianAndMean {
  Interval median, mean;
};

/// Gives the BootstrapIntervals of median and mean, to the bit, but draws the resamples once.
std::optional<MedianAndMean> BootstrapMedianAndMean(std::span<const double> values, std::uint64_t seed,
                                                    const std::string& purpose, double confidence = kConfidence);

}  // namespace etude
