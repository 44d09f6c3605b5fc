#include "bench/statistics/interval.h"

#include <algorithm>
#include <cmath>

#include "bench/statistics/distributions.h"

namespace etude {
namespace {

double TwoSidedQuantile(double confidence) { return KeepThirtyBits(NormalQuantile(0.5 + confidence / 2)); }

}  // namespace

Interval WilsonInterval(int count, int of, double confidence) {
  const double z = TwoSidedQuantile(confidence), n = of, share = count / n;
  const double centre = (share + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  // If the share is 0 or 1, the end of the interval on that side is the share itself; the formula's value would differ
  // from the share by rounding.
  return {count == 0 ? 0 : centre - half, count == of ? 1 : centre + half, IntervalKind::kWilson};
}

Interval PairedShareInterval(int gained, int lost, int pairs, double confidence) {
  const double n = pairs + 2, up = (gained + 1) / n, down = (lost + 1) / n;
  const double half = TwoSidedQuantile(confidence) * std::sqrt((up + down - (up - down) * (up - down)) / n);
  return {std::max(up - down - half, -1.0), std::min(up - down + half, 1.0), IntervalKind::kAdjustedWald};
}

}  // namespace etude
