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

/// Returns true if all values are 0 or 1, so that their means are shares; amounts never are.
bool AreShares(std::span<const Pair> pairs, const MetricInfo& metric);

/// Returns method − baseline, free of rounding: differences below a billionth of the practical threshold become zero,
/// and others are rounded to 30 bits. Values that differ only in their last bits are therefore ties, also in ranks.
double DifferenceOf(const Pair& pair, const MetricInfo& metric);

/// Compares two methods on the worlds in which both have a value. Returns the aggregate of the paired differences with
/// its BCa interval (PairedShareInterval if all values are 0 or 1), their mean with its own interval, both tests, the
/// effect size, and the verdict if this were the only comparison. Differences below a billionth of the practical
/// threshold are zeros. `seed` and `purpose` key the random streams. The caller fills in the names, the counts of
/// worlds without a pair, and the notes.
Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose, double confidence = kConfidence);

/// Returns the p-value of the test that decides: Wilcoxon's if the metric's aggregate is the median, the sign-flip test
/// if it is the mean. The choice depends on the metric, never on the result.
std::optional<double> DecidingP(const Comparison& comparison, const MetricInfo& metric);

/// Returns true if the bootstrap of a mean rests on too few differences to exclude rare large ones. If all 8 worlds of
/// a sample are equal, the interval has no width; but a difference that occurs in one world of ten is absent from 43 %
/// of such samples.
bool SeesTooFewDiffer(const Comparison& comparison, const MetricInfo& metric);

/// Returns the verdict by interval, `p_holm` and the metric's practical threshold, alpha = 1 − confidence:
///   no difference    the intervals of the metric's own aggregate and of the mean both lie within ± threshold
///                    (equivalence; at 95 % stricter than two one-sided 5 % tests). The mean is needed too, because a
///                    median does not show differences in fewer than half of the worlds. A bootstrapped mean also
///                    needs kMinSample pairs that differ, because a bootstrap cannot see rare differences
///   better / worse   p_holm ≤ alpha, the interval lies on one side of zero, and |difference| is at least the threshold
///   inconclusive     anything else; always with fewer than kMinSample pairs
Verdict VerdictOf(const Comparison& comparison, const MetricInfo& metric, double confidence = kConfidence);

/// Judges with and without failures. If there are failures, the comparison's p becomes the one that counts them, and
/// its verdict the one on which both ways agree, or kInconclusive if they differ. Both inputs must have their own
/// `p_holm`. Returns the verdict that ignores failures.
Verdict JudgeBothWays(Comparison& comparison, const std::optional<Comparison>& with_failures, const MetricInfo& metric,
                      double confidence = kConfidence);

}  // namespace etude
