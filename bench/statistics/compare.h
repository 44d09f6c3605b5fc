#pragma once

#include <span>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/results/run_data.h"

namespace etude {

/// The values of one metric of two methods in the same world.
struct Pair {
  double baseline = 0;
  double method = 0;
};

/// Compares two methods on the worlds in which both have a value. The verdict goes by the 95 % interval
/// of the paired difference and by the metric's practical threshold:
///   better / worse   the interval lies wholly on one side of zero, and its aggregate beyond the threshold
///   no difference    the interval lies wholly within ± threshold, or beyond zero by less than it
///   inconclusive     anything else, or fewer than kSmallestSample pairs
/// `seed` and `purpose` key the bootstrap. The names in the result are left for the caller.
Comparison ComparePaired(std::span<const Pair> pairs, const MetricInfo& metric, std::uint64_t seed,
                         const std::string& purpose);

}  // namespace etude
