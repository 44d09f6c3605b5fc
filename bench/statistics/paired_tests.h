#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"

namespace etude {

/// Both tests are two-sided. Their null hypothesis is that the differences are symmetric around zero: swapping the two
/// methods in a world changes nothing. Neither can reach a p below 2 / 2ⁿ with n non-zero differences.

/// Wilcoxon's signed-rank test. Zeros are treated by Pratt (1959): they are ranked with the others, and then their
/// ranks are left out. Tied differences share their mean rank. With up to 50 non-zero differences the p is exact given
/// the ranks, with or without ties (shift algorithm, Streitberg & Röhmel 1986); with more it is the normal
/// approximation with its variance corrected for ties, and continuity correction. p = 1 if all differences are zero; no
/// p without differences.
PairedTest SignedRankTest(std::span<const double> differences);

/// Returns the matched-pairs rank-biserial correlation (Kerby 2014): (rank sum of the positive − of the negative
/// differences) / (rank sum of both), −1…1, with the ranks of the signed-rank test. 0 if all differences are zero.
double RankBiserial(std::span<const double> differences);

/// The sign-flip permutation test (Fisher 1935) of the differences' median or mean. With up to 16 non-zero differences
/// it is exact, by enumeration. For a mean of differences of one sign it is exact, 2 / 2ⁿ, and of equal size, by the
/// binomial (for shares this is McNemar's exact test). Otherwise it draws 9,999 sign vectors from a stream keyed by
/// `seed` and `purpose`, p = (b + 1) / (m + 1) (Phipson & Smyth 2010). With more than kMaxResampled differences it is
/// the normal approximation; for a median, that of the sign test.
PairedTest SignFlipTest(std::span<const double> differences, Aggregate aggregate, std::uint64_t seed,
                        const std::string& purpose);

/// Returns the smallest p that either test can reach with `differing` non-zero differences: 2 / 2ⁿ, at most 1.
double SmallestP(int differing);

/// Returns the number of non-zero differences that a test needs to reach p ≤ alpha / comparisons, the first step of
/// Holm's correction.
int PairsNeeded(int comparisons, double alpha);

}  // namespace etude
