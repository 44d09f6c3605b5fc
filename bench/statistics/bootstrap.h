#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/statistics/interval.h"

namespace etude {

double Mean(std::span<const double> values);

/// Returns the median or the mean of the values. `values` must not be empty.
double AggregateOf(std::span<const double> values, Aggregate aggregate);

/// The smallest sample that has an interval: the sign test of five values cannot reach 95 %.
constexpr int kMinSample = 6;

/// Returns the bias-corrected and accelerated (BCa) bootstrap interval of any statistic (Efron 1987, section 3).
/// `replicates` are the statistic's bootstrap replicates; they are sorted here. `jackknife` holds the statistic's
/// values with one observation left out each. Replicates that equal the estimate count half as below it and half as
/// above it. Each end of the interval is one of the replicates. If the correction is undefined (all replicates on one
/// side of the estimate, or all jackknife values equal), the result is the percentile interval (Efron 1979), and its
/// kind says so.
Interval BcaInterval(std::vector<double>& replicates, double estimate, std::span<const double> jackknife,
                     double confidence = kConfidence);

/// The largest sample that is resampled. For larger samples, closed forms give the same interval within a tenth of its
/// width (tested with log-normal values) at no cost.
constexpr int kMaxResampled = 5'000;

/// Returns the BCa interval of the values' aggregate, from 1,999 resamples drawn from a random stream keyed by `seed`
/// and `purpose`. The order of the values has no effect. Samples above kMaxResampled get the interval of order
/// statistics for the median, and Student's interval for the mean. Returns nothing for fewer than kMinSample values.
std::optional<Interval> BootstrapInterval(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                          const std::string& purpose, double confidence = kConfidence);

struct MedianAndMean {
  Interval median, mean;
};

/// Returns the two intervals that BootstrapInterval returns for median and mean, bit for bit, but draws the resamples
/// only once.
std::optional<MedianAndMean> BootstrapMedianAndMean(std::span<const double> values, std::uint64_t seed,
                                                    const std::string& purpose, double confidence = kConfidence);

}  // namespace etude
