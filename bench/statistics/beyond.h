#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/statistics/scenario_table.h"

namespace etude {

/// The differences of the worlds of one comparison, and the units (clips, libraries) that each world was drawn from.
struct UnitSample {
  std::vector<double> differences;      ///< method − baseline, one per world
  std::vector<std::vector<int>> units;  ///< per world: the indices in `names` of its units, one or more
  std::vector<std::string> names;

  /// True if each world was drawn from one unit.
  bool IsOneWay() const;
};

/// Returns the differences of the pairs with their units. Worlds that name no unit are left out.
UnitSample UnitsOf(const PairedWorlds& paired, const ConditionTable& table, const MetricInfo& metric);

/// The smallest number of units that can have a verdict: a sign test of five values cannot reach 5 %.
constexpr int kMinUnits = 6;

/// Estimates the difference for other units like those of the sample. The verdict is left open.
///
/// *One unit per world*: the estimate is the mean of the units' mean differences; its interval is Student's over these
/// means. The test flips the signs of the means where that can reach 5 % among `comparisons` (2^(1 − units) ×
/// comparisons ≤ 0.05), and is the t test otherwise. The choice depends on the numbers of units and comparisons, never
/// on the result.
///
/// *Several units per world* (clip left × clip entered): worlds that share a clip, in either role, are correlated. The
/// estimate is the mean over worlds; its standard error is the jackknife's that leaves out one clip with all its worlds
/// (Tukey 1958; for nodes of a network Snijders & Borgatti 1999), with Student's t of clips − 1 degrees of freedom.
/// With one unit per world this is the interval above.
///
/// With fewer than kMinUnits units the result holds the estimate and the leave-one-out estimates, but no interval and
/// no test.
Beyond MeasureBeyond(const UnitSample& sample, int comparisons, std::uint64_t seed, const std::string& purpose);

/// Returns the verdict that the estimate and its `p_holm` allow:
///   nothing          fewer than kMinUnits units
///   no difference    the intervals of mean and median over units lie within ± threshold, and at least kMinUnits differ
///   better / worse   p_holm ≤ alpha, the interval lies on one side of zero, and |mean| is at least the threshold
///   inconclusive     anything else
std::optional<Verdict> VerdictBeyond(const Beyond& beyond, const MetricInfo& metric);

/// Says in words why there is no verdict or an inconclusive one; returns "" if the verdict is clear. `comparisons` is
/// the number of comparisons that were made together (Holm).
std::string WhyOpenBeyond(const Beyond& beyond, const MetricInfo& metric, SamplingUnit unit, int comparisons);

}  // namespace etude
