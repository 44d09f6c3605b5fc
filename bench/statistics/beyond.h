#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/statistics/scenario_table.h"

namespace etude {

/// Differences of worlds, and the units (clips, libraries) that each world was drawn from.
struct UnitSample {
  std::vector<double> differences;      ///< of worlds, method − baseline
  std::vector<std::vector<int>> units;  ///< of each world one or more, indices of `names`
  std::vector<std::string> names;

  /// True if each world was drawn from one unit.
  bool IsOneWay() const;
};

/// The pairs of a condition by unit; worlds that name no unit are left out.
UnitSample UnitsOf(const PairedWorlds& paired, const ConditionTable& table, const MetricInfo& metric);

/// The smallest number of units with a verdict beyond them: no test of the signs of five can reach 5 %.
constexpr int kFewestUnits = 6;

/// Estimates the difference for other units like the sample's; the verdict is left open.
///
/// *One unit a world*: the estimate is the mean of the units' mean differences, its interval Student's over those
/// means. The test flips the means' signs where that can reach 5 % among `comparisons` (2^(1 − units) × comparisons ≤
/// 0.05), else it is the t test: fixed by numbers of units and comparisons, never by the result.
///
/// *Several units a world* (clip left × clip entered): worlds that share a clip, in whatever part, resemble each other.
/// The estimate is the mean over worlds; its standard error is the jackknife's that leaves out one clip with all its
/// worlds (Tukey 1958; of nodes of a network Snijders & Borgatti 1999), with Student's t of clips − 1 degrees of
/// freedom. With one unit a world this is the interval above.
///
/// Below kFewestUnits the estimate and what leaving one out does, without interval or test.
Beyond MeasureBeyond(const UnitSample& sample, int comparisons, std::uint64_t seed, const std::string& purpose);

/// The verdict that the estimate and its `p_holm` allow:
///   nothing          fewer than kFewestUnits units
///   no difference    the intervals of mean and median over units lie within ± threshold, and kFewestUnits differ
///   better / worse   p_holm ≤ alpha, the interval lies on one side of zero, the mean is at least the threshold
///   inconclusive     anything else
std::optional<Verdict> VerdictBeyond(const Beyond& beyond, const MetricInfo& metric);

/// Explains in words why there is no verdict or an inconclusive one; "" when it is clear. `comparisons` were made
/// together.
std::string WhyOpenBeyond(const Beyond& beyond, const MetricInfo& metric, SamplingUnit unit, int comparisons);

}  // namespace etude
