#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/metrics/catalogue.h"

namespace etude {

/// The q-quantile of the values, 0 ≤ q ≤ 1, linear between order statistics (Hyndman & Fan 1996,
/// type 7: numpy's and R's default). `values` must not be empty.
double Quantile(std::span<const double> values, double q);
double Mean(std::span<const double> values);

/// Median or mean, as the metric is aggregated.
double AggregateOf(std::span<const double> values, Aggregate aggregate);

struct Interval {
  double low = 0;
  double high = 0;
};

/// A sample smaller than this has no interval: a percentile bootstrap of five values can't reach 95 %.
constexpr int kSmallestSample = 6;

/// The 95 % percentile-bootstrap interval of the aggregate (Efron 1979), from 2,000 resamples of a
/// stream keyed by `seed` and `purpose`. Nothing for fewer than kSmallestSample values.
std::optional<Interval> BootstrapInterval(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                          const std::string& purpose);

}  // namespace etude
