#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace etude {

/// Returns the 95th percentile, interpolated linearly between order statistics (rank 0.95 (n − 1)). At least one value
/// is required.
inline double Percentile95(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  constexpr double kShare = 0.95;
  const double rank = kShare * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

}  // namespace etude
