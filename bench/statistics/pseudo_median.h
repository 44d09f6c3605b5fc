#pragma once

#include <optional>
#include <span>
#include <utility>

namespace etude {

/// The pseudo-median of a sample: the median of its Walsh averages, which are the means of every pair of values, each
/// value paired with itself, too (Hodges & Lehmann 1963). Of symmetric values it estimates their mean; one value in ten
/// that lies far off hardly moves it.
struct PseudoMedian {
  double value = 0;
  /// The 95 % interval: the locations that Wilcoxon's signed-rank test does not reject (Hollander & Wolfe,
  /// section 3.3). Its ends are Walsh averages. The ranks are exact for up to 50 values, and normal for more. Nothing
  /// below six values, because the test of five cannot reach 5 %.
  std::optional<std::pair<double, double>> interval;
};

/// Returns the pseudo-median of at least one value. Costs O(n log n).
PseudoMedian PseudoMedianOf(std::span<const double> values);

}  // namespace etude
