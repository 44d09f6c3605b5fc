#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"

namespace etude {

/// Both tests ask, two-sided, whether the differences are symmetric around zero: whether it makes no odds which of
/// the two methods a value came from. Neither can reach a p below 2 / 2ⁿ with n differences other than zero.

/// Wilcoxon's signed-rank test. Zeros are treated by Pratt (1959): ranked with the others, then left out; tied
/// differences share their mean rank. With up to 50 differences other than zero the p is exact given the ranks, ties
/// or not (the shift algorithm of Streitberg & Röhmel 1986); with more it is the normal approximation with its
/// variance corrected for ties, and continuity. p = 1 when all differences are zero; no p without differences.
PairedTest SignedRankTest(std::span<const double> differences);

/// Matched-pairs rank-biserial correlation (Kerby 2014): (rank sum of the positive − of the negative differences) /
/// (rank sum of both), −1…1, by the ranks of the signed-rank test. 0 when all differences are zero.
double RankBiserial(std::span<const double> differences);

/// The sign-flip permutation test (Fisher 1935) of the differences' median or mean. Exact by enumeration with up to
/// 16 differences other than zero; exact by the binomial for a mean of differences of one size (for shares this is
/// McNemar's exact test); else 9,999 draws of a stream keyed by `seed` and `purpose`, p = (b + 1) / (m + 1)
/// (Phipson & Smyth 2010); of more than kLargestResampled differences the normal approximation, for a
/// median of the sign test.
PairedTest SignFlipTest(std::span<const double> differences, Aggregate aggregate, std::uint64_t seed,
                        const std::string& purpose);

/// The smallest p that either test can reach with so many differences other than zero: 2 / 2ⁿ, at most 1.
double SmallestP(int differing);

/// The number of differences other than zero that a test needs to reach p ≤ alpha / comparisons, the first step of
/// Holm's correction.
int PairsNeeded(int comparisons, double alpha);

}  // namespace etude
