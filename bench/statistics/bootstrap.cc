#include "bench/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr int kResamples = 2000;
constexpr double kTail = 0.025;

/// Quantile of values that may be reordered: two selections instead of a whole sort.
double QuantileInPlace(std::vector<double>& values, double q) {
  const double position = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

}  // namespace

double Quantile(std::span<const double> values, double q) {
  std::vector<double> copy(values.begin(), values.end());
  return QuantileInPlace(copy, q);
}

double Mean(std::span<const double> values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double AggregateOf(std::span<const double> values, Aggregate aggregate) {
  return aggregate == Aggregate::kMedian ? Quantile(values, 0.5) : Mean(values);
}

std::optional<Interval> BootstrapInterval(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                          const std::string& purpose) {
  if (static_cast<int>(values.size()) < kSmallestSample) return std::nullopt;
  RandomStream dice({.suite_seed = seed, .scenario = "bootstrap", .trial = 0}, purpose);
  std::vector<double> aggregates(kResamples);
  std::vector<double> resample(values.size());
  for (double& value : aggregates) {
    for (double& drawn : resample) drawn = values[dice.IndexBelow(values.size())];
    value = aggregate == Aggregate::kMedian ? QuantileInPlace(resample, 0.5) : Mean(resample);
  }
  return Interval{QuantileInPlace(aggregates, kTail), QuantileInPlace(aggregates, 1 - kTail)};
}

}  // namespace etude
