#pragma once

#include <optional>
#include <span>
#include <utility>

namespace etude {

/// The pseudo-median of a sample: the median of its Walsh averages, which are the means of all pairs of values,
/// including each value with itself (Hodges & Lehmann 1963). For a symmetric distribution it estimates the mean; if one
/// value in ten is an outlier, it hardly moves.
struct PseudoMedian {
  double value = 0;
  /// The 95 % interval: the locations that Wilcoxon's signed-rank test does not reject (Hollander & Wolfe, section
  /// 3.3). Its ends are Walsh averages. The ranks are exact for up to 50 values, and a normal approximation for more.
  /// Nullopt below six values, because the test of five values cannot reach 5 %.
  std::optional<std::pair<double, double>> interval;
};

/// Returns the pseudo-median of at least one value. Costs O(n log n).
PseudoMedian PseudoMedianOf(std::span<const double> values);

}  // namespace etude
