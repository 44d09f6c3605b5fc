#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"
#include "bench/statistics/interval.h"

namespace etude {

/// The values of one metric that two methods have in the same world.
struct Pair {
  double baseline = 0;
  double method = 0;
};

/// Returns true if all values are 0 or 1 and the metric is not an amount: the mean of the values is then a share.
bool AreShares(std::span<const Pair> pairs, const MetricInfo& metric);

/// Returns method − baseline without the effects of rounding. A difference below a billionth of the practical threshold
/// becomes zero; others are rounded to 30 bits. Values that differ only in their last bits are therefore ties, also in
/// ranks.
double DifferenceOf(const Pair& pair, const MetricInfo& metric);

/// Compares two methods on the worlds in which both have a value. Returns the aggregate of the paired differences with
/// its BCa interval (PairedShareInterval if all values are 0 or 1), the mean difference with its interval, both tests,
/// the effect size, and the verdict as if this were the only comparison. `seed` and `purpose` key the random streams.
/// The caller fills in the names, the counts of worlds without a pair, and the notes.
Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose, double confidence = kConfidence);

/// Returns the p-value of the test that decides: of Wilcoxon's test if the metric's aggregate is the median, of the
/// sign-flip test if it is the mean. The choice depends on the metric, never on the result.
std::optional<double> DecidingP(const Comparison& comparison, const MetricInfo& metric);

/// Returns true if too few pairs differ for the bootstrap interval of a mean to rule out rare large differences. For
/// example, if both methods agree in all 8 worlds of a sample, the interval has no width. But a difference that occurs
/// in one world of ten is absent from 43 % of such samples.
bool SeesTooFewDiffer(const Comparison& comparison, const MetricInfo& metric);

/// Returns the verdict, which follows from the interval, `p_holm`, the metric's practical threshold and alpha =
/// 1 − confidence:
///   no difference    if the intervals of the metric's own aggregate and of the mean both lie within ± threshold (a
///                    test of equivalence; at 95 % it is stricter than two one-sided 5 % tests). The mean is tested
///                    too, because a median does not show differences in fewer than half of the worlds. If the mean's
///                    interval is bootstrapped, at least kMinSample pairs must differ, because a bootstrap cannot see
///                    rare differences
///   better / worse   if p_holm ≤ alpha, the interval lies on one side of zero, and |difference| ≥ threshold
///   undecided        otherwise, and always with fewer than kMinSample pairs or if the two were not judged alike
Verdict VerdictOf(const Comparison& comparison, const MetricInfo& metric, double confidence = kConfidence);

/// Judges a comparison of pairs alone and, if `with_failures` is given, the same comparison with failures counted. Both
/// must have their own `p_holm`. `comparison.p_holm` becomes that of `with_failures`. If both comparisons then have the
/// same verdict, `comparison.verdict` is this verdict, otherwise kUndecided. Returns the verdict of the pairs alone by
/// their own p or, if that verdict is undecided, by the p of `with_failures`.
Verdict JudgeBothWays(Comparison& comparison, const std::optional<Comparison>& with_failures, const MetricInfo& metric,
                      double confidence = kConfidence);

}  // namespace etude
