#include "bench/statistics/pseudo_median.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "bench/statistics/interval.h"

namespace etude {
namespace {

/// The largest number of values for which the quantile of the signed-rank statistic is exact. For more, a normal
/// approximation is used.
constexpr std::int64_t kMaxExactValues = 50;

/// Returns the number of Walsh averages that are at most `limit`. A Walsh average is the mean of two values, or of a
/// value and itself. The values are in ascending order.
std::int64_t CountWalshAverages(std::span<const double> ascending, double limit) {
  std::int64_t count = 0;
  auto end = static_cast<std::int64_t>(ascending.size());  // value i has averages ≤ `limit` with values i … end − 1
  for (std::int64_t i = 0; i < end; ++i) {
    while (end > i &&
           (ascending[static_cast<std::size_t>(i)] + ascending[static_cast<std::size_t>(end - 1)]) / 2 > limit)
      --end;
    count += end - i;
  }
  return count;
}

/// OrderOf maps a finite double to an integer, and ValueAt maps it back. The integers have the order of the doubles.
std::int64_t OrderOf(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}
double ValueAt(std::int64_t order) {
  return std::bit_cast<double>(order >= 0 ? order : std::numeric_limits<std::int64_t>::min() - order);
}

/// Returns the k-th smallest Walsh average, k = 1 … n (n + 1) / 2: the smallest double x for which at least k
/// averages are ≤ x. Bisection over the doubles finds it.
double WalshAverage(std::span<const double> ascending, std::int64_t k) {
  std::int64_t low = OrderOf(ascending.front()), high = OrderOf(ascending.back());
  while (low < high) {
    const std::int64_t middle =
        low + static_cast<std::int64_t>((static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low)) / 2);
    if (CountWalshAverages(ascending, ValueAt(middle)) >= k) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return ValueAt(high);
}

/// Returns the rank of the interval's lower end among the Walsh averages. This is the number of values w of the
/// signed-rank statistic with P(W ≤ w) ≤ 2.5 %. `n` is at least kMinSample.
std::int64_t RankOfEnd(std::int64_t n) {
  if (n > kMaxExactValues) {
    const auto count = static_cast<double>(n);
    const double mean = count * (count + 1) / 4, variance = mean * (2 * count + 1) / 6;
    return static_cast<std::int64_t>(std::floor(mean + NormalQuantile(kAlpha / 2) * std::sqrt(variance) + 0.5));
  }
  // For each sum, count the subsets of the ranks 1 … n with that sum. Counts are at most 2⁵⁰, so a double stores them
  // exactly.
  std::vector<double> ways(static_cast<std::size_t>(n * (n + 1) / 2 + 1));
  ways[0] = 1;
  for (std::int64_t rank = 1; rank <= n; ++rank) {
    for (auto sum = static_cast<std::size_t>(rank * (rank + 1) / 2); sum >= static_cast<std::size_t>(rank); --sum) {
      ways[sum] += ways[sum - static_cast<std::size_t>(rank)];
    }
  }
  const double most = std::ldexp(kAlpha / 2, static_cast<int>(n));
  double below = 0;
  std::int64_t w = 0;
  while ((below += ways[static_cast<std::size_t>(w)]) <= most) ++w;
  return w;
}

}  // namespace

PseudoMedian PseudoMedianOf(std::span<const double> values) {
  assert(!values.empty());
  std::vector<double> ascending(values.begin(), values.end());
  std::sort(ascending.begin(), ascending.end());
  const auto n = static_cast<std::int64_t>(ascending.size());
  const std::int64_t averages = n * (n + 1) / 2;
  PseudoMedian found;
  found.value = std::midpoint(WalshAverage(ascending, (averages + 1) / 2), WalshAverage(ascending, averages / 2 + 1));
  if (n < kMinSample) return found;
  const std::int64_t rank = RankOfEnd(n);
  found.interval = {WalshAverage(ascending, rank), WalshAverage(ascending, averages + 1 - rank)};
  return found;
}

}  // namespace etude
