#pragma once

#include <string>
#include <vector>

#include "bench/statistics/scenario_table.h"

namespace etude {

/// The differences of the worlds of one comparison, and the units (clips, libraries) from which each world was drawn.
struct UnitSample {
  std::vector<double> differences;      ///< method − baseline, one per world
  std::vector<std::vector<int>> units;  ///< for each world, the indices in `names` of the world's units; at least one
  std::vector<std::string> names;
  bool yes_or_no = false;  ///< true: the metric is yes or no, so differences are −1, 0 or 1

  /// Returns true if each world was drawn from one unit.
  bool IsOneWay() const;
};

/// Returns the differences of the pairs, and the units of their worlds. Worlds that name no unit are left out.
UnitSample UnitsOf(const PairedWorlds& paired, const ConditionTable& table, const MetricInfo& metric);

/// The smallest number of units that can have a verdict: a sign test of five values cannot reach 5 %.
constexpr int kMinUnits = 6;

/// Estimates the difference for units that were not run but are of the same kind as the sample's. The verdict is left
/// open.
///
/// Each unit contributes one value. If each world has *one unit*, this value is the mean of the unit's differences. If
/// worlds have *several units* (playing clip × wanted clip), worlds that share a clip in either role are correlated.
/// The value of a unit is then the jackknife's pseudo-value: n · mean − (n − 1) · (mean without the unit's worlds)
/// (Tukey 1958; for nodes of a network Snijders & Borgatti 1999).
///
/// The estimate is the pseudo-median of these values, with its interval, because the interval of a mean over few units
/// fails if the values are skewed or one is an outlier (docs/findings/verdicts.md). The mean is also reported, with
/// Student's interval from the jackknife's standard error. If every unit's value is −1, 0 or 1 (one yes-or-no world
/// each), the estimate is the mean, with the interval of the difference of two shares. If the mean of such values is
/// zero, they are symmetric about zero, as the signed-rank test requires. The test is Wilcoxon's signed-rank test of
/// the values if its smallest p can pass Holm's correction (2^(1 − units) × comparisons ≤ 0.05), and Student's t test
/// of their mean otherwise. The choice depends on the numbers of units and comparisons, never on the result.
///
/// With fewer than kMinUnits units the result holds the estimate and the leave-one-out means, but no interval and
/// no test.
Beyond MeasureBeyond(const UnitSample& sample, int comparisons);

/// Returns the verdict that the estimate and its `p_holm` allow:
///   nothing          if there are fewer than kMinUnits units
///   no difference    if the intervals of pseudo-median and mean lie within ± threshold, and at least kMinUnits units
///                    differ
///   better / worse   if p_holm ≤ alpha, the interval of the pseudo-median lies on one side of zero, the pseudo-median
///                    is at least as large as the threshold, and the mean has the same sign
///   undecided        otherwise, and always if the two methods were not judged alike
std::optional<Verdict> VerdictBeyond(const Beyond& beyond, const MetricInfo& metric);

/// Returns a sentence that says why the verdict is missing or undecided; "" if the verdict is clear.
/// `comparisons` is the number of comparisons that were made together (Holm).
std::string WhyOpenBeyond(const Beyond& beyond, const MetricInfo& metric, SamplingUnit unit, int comparisons);

}  // namespace etude
