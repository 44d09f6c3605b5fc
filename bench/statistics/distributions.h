#pragma once

namespace etude {

/// Returns Φ(x), the cumulative distribution function of the standard normal distribution.
double NormalCdf(double x);
/// Returns Φ⁻¹(p), the p-quantile of the standard normal distribution, 0 < p < 1.
double NormalQuantile(double p);

/// StudentQuantile returns the p-quantile of Student's t with `freedom` > 0 degrees of freedom; StudentTwoSided returns
/// P(|T| ≥ |t|).
double StudentQuantile(double p, int freedom);
double StudentTwoSided(double t, int freedom);

/// Returns P(B ≥ successes) for B ~ Binomial(trials, ½), 0 ≤ successes ≤ trials.
double FairCoinUpperTail(int successes, int trials);

/// Returns the value rounded to 30 bits of mantissa. Values of a summary that depend on exp or log are rounded in this
/// way, because the last bits of these functions differ between machines.
double KeepThirtyBits(double value);

/// Returns the smallest mean difference that a two-sided paired t test at 5 % finds with a power of 80 %. Its unit is
/// the standard deviation of the n = `count` > 1 independent differences. For m = `comparisons` tests (Bonferroni, the
/// first step of Holm) it is (t(1 − 0.05 / 2m) + t(0.8)) / √n, where both quantiles t have n − 1 degrees of freedom.
double MinDetectableDifference(int count, int comparisons);

}  // namespace etude
