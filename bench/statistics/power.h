#pragma once

namespace etude {

/// The smallest mean difference, in standard deviations of the `count` independent differences (> 1), that a two-sided
/// paired t test at 5 % among so many comparisons (Bonferroni, the first step of Holm) finds with a chance of 80 %:
/// (t(1 − 0.05 / 2m) + t(0.8)) / √n, both of n − 1 degrees of freedom.
double SmallestFinding(int count, int comparisons);

}  // namespace etude
