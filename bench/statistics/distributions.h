#pragma once

namespace etude {

/// Φ(x) of the standard normal.
double NormalCdf(double x);
/// Φ⁻¹(p), 0 < p < 1.
double NormalQuantile(double p);

/// Student's t of so many degrees of freedom (> 0): the p-quantile, and P(|T| ≥ |t|).
double StudentQuantile(double p, int freedom);
double StudentTwoSided(double t, int freedom);

/// P(B ≥ successes) of B ~ Binomial(trials, ½), 0 ≤ successes ≤ trials.
double FairCoinUpperTail(int successes, int trials);

/// The value with 30 bits of mantissa. What stands in a summary must not depend on the last bit of the
/// machine's exp and log.
double KeepThirtyBits(double value);

/// The smallest mean difference, in standard deviations of the `count` independent differences (> 1), that a two-sided
/// paired t test at 5 % among so many comparisons (Bonferroni, the first step of Holm) finds with a chance of 80 %:
/// (t(1 − 0.05 / 2m) + t(0.8)) / √n, both of n − 1 degrees of freedom.
double SmallestFinding(int count, int comparisons);

}  // namespace etude
