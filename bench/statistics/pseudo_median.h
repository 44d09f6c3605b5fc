#pragma once

#include <optional>
#include <span>
#include <utility>

namespace etude {

/// The pseudo-median of a sample: the median of its Walsh averages (Hodges & Lehmann 1963). The Walsh averages are the
/// means of all pairs of values, including each value with itself. For a symmetric distribution the pseudo-median
/// estimates the mean. It hardly moves if one value in ten is an outlier.
struct PseudoMedian {
  double value = 0;
  /// The 95 % interval: the locations that Wilcoxon's signed-rank test does not reject (Hollander & Wolfe, section
  /// 3.3). Its ends are Walsh averages. The ranks of these ends are exact for up to 50 values; for more, they come from
  /// a normal approximation. The interval is nullopt for fewer than six values, because a test of five values cannot
  /// reach 5 %.
  std::optional<std::pair<double, double>> interval;
};

/// Returns the pseudo-median of at least one value, in O(n log n) time.
PseudoMedian PseudoMedianOf(std::span<const double> values);

}  // namespace etude
