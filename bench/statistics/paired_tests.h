#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"

namespace etude {

/// The signed-rank test and the sign-flip test are two-sided. Their null hypothesis is that the differences are
/// symmetric around zero, i.e. that exchanging the two methods in a world changes nothing. With n non-zero differences,
/// neither test can reach a p below 2 / 2ⁿ.

/// Computes Wilcoxon's signed-rank test. Zeros are treated as by Pratt (1959): they are ranked with the other
/// differences, and then their ranks are left out. Tied differences share their mean rank. Up to 50 non-zero
/// differences, p is exact given the ranks, with or without ties (shift algorithm, Streitberg & Röhmel 1986). Above
/// that, p comes from a normal approximation with continuity correction and a variance corrected for ties. p = 1 if all
/// differences are zero; there is no p without differences.
PairedTest SignedRankTest(std::span<const double> differences);

/// Returns the matched-pairs rank-biserial correlation (Kerby 2014), −1…1: the rank sum of the positive differences
/// minus the rank sum of the negative ones, divided by the total of these two sums. The ranks are those of the
/// signed-rank test. The correlation is 0 if all differences are zero.
double RankBiserial(std::span<const double> differences);

/// Computes the sign-flip permutation test (Fisher 1935) of the differences' median or mean. Of a median, p is not
/// small even if all differences are equal, because most sign vectors then give a median of the same size. Up to 16
/// non-zero differences, all sign vectors are enumerated, and p is exact. For a mean, p has a closed form in two more
/// cases. If all n differences have the same sign, p = 2 / 2ⁿ; differences within rounding are not counted, and n above
/// 1000 is taken as 1000. If all differences have the same size, p comes from the binomial distribution (for shares
/// this is McNemar's exact test). Otherwise m = 9,999 sign vectors are drawn from a stream keyed by `seed` and
/// `purpose`. b of them have an aggregate at least as far from zero as the observed one, and p = (b + 1) / (m + 1)
/// (Phipson & Smyth 2010). Above kMaxResampled differences, p comes from a normal approximation; for a median, from the
/// normal approximation of the sign test.
PairedTest SignFlipTest(std::span<const double> differences, Aggregate aggregate, std::uint64_t seed,
                        const std::string& purpose);

/// Returns the smallest p that either test can reach with `differing` = n non-zero differences: 2 / 2ⁿ, at most 1.
double SmallestP(int differing);

/// Returns the number of non-zero differences with which a test can reach p ≤ alpha / comparisons, the first step of
/// Holm's correction.
int PairsNeeded(int comparisons, double alpha);

}  // namespace etude
