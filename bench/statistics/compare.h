#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"
#include "bench/statistics/interval.h"

namespace etude {

/// The values of one metric of two methods in the same world.
struct Pair {
  double baseline = 0;
  double method = 0;
};

/// True if all values are 0 or 1.
bool AreShares(std::span<const Pair> pairs);

/// method − baseline, without rounding: what differs in the last bits alone is a tie, of ranks as of values.
double DifferenceOf(const Pair& pair, const MetricInfo& metric);

/// Compares two methods on the worlds in which both have a value: the paired differences' aggregate with its BCa
/// interval (of shares, whose values are all 0 or 1: PairedShareInterval), their mean with its own, both tests, the
/// effect size, and the verdict if this were the only comparison. Differences below a billionth of the practical
/// threshold are zeros. `seed` and `purpose` key the dice. The names, the
/// worlds without a pair and the notes are left for the caller.
Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose, double confidence = kConfidence);

/// The p of the test that decides, fixed by the metric and never by the result: of Wilcoxon's where the aggregate is
/// the median, of the sign flips where it is the mean.
std::optional<double> DecidingP(const Comparison& comparison, const MetricInfo& metric);

/// True if a mean's bootstrap rests on too few differences to exclude rare large ones: of 8 worlds that are all equal
/// it makes an interval of no width, and a difference in every tenth world goes unseen in 43 % of such samples.
bool SeesTooFewDiffer(const Comparison& comparison, const MetricInfo& metric);

/// The verdict by interval, `p_holm` and the metric's practical threshold, alpha = 1 − confidence:
///   no difference    the intervals of the metric's own aggregate and of the mean both lie within ± threshold
///                    (equivalence; at 95 % stricter than two one-sided 5 % tests): a median alone hides behind ties;
///                    of a bootstrapped mean only when kSmallestSample pairs differ, for it can't see what is rare
///   better / worse   p_holm ≤ alpha, the interval lies on one side of zero, the difference is at least the threshold
///   inconclusive     anything else; always with fewer than kSmallestSample pairs
Verdict VerdictOf(const Comparison& comparison, const MetricInfo& metric, double confidence = kConfidence);

/// Gives the comparison the p with failures counted, if there are any, and the verdict that holds with and without
/// them, else kInconclusive. Both come with their own `p_holm`. Returns what would be said without the failures.
Verdict JudgeBothWays(Comparison& comparison, const std::optional<Comparison>& with_failures, const MetricInfo& metric,
                      double confidence = kConfidence);

}  // namespace etude
