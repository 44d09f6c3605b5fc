#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace etude {

/// Returns the median: for an even number of values the midpoint of the two middle ones. `values` must not be empty or
/// contain NaN.
inline double Median(std::vector<double> values) {
  assert(!values.empty());
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  return values.size() % 2 == 1 ? *upper : 0.5 * (*std::max_element(values.begin(), upper) + *upper);
}

/// Returns a quantile: the value of rank share·(n − 1) in ascending order, interpolated linearly between neighbours,
/// for `share` in 0…1. `values` must not be empty or contain NaN.
inline double Quantile(std::span<const double> values, double share) {
  assert(!values.empty());
  std::vector<double> copy(values.begin(), values.end());
  const double rank = share * static_cast<double>(copy.size() - 1);
  const auto below = copy.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(copy.begin(), below, copy.end());
  if (below + 1 == copy.end()) return *below;
  const double above = *std::min_element(below + 1, copy.end());
  return *below + (rank - static_cast<double>(below - copy.begin())) * (above - *below);
}

/// Returns the value of rank size/2 in ascending order, counted from 0: for an even number of values the upper of the
/// two middle ones, never their mean; cheaper than `Median`. `values` must not be empty or contain NaN.
template <class T>
T UpperMedian(std::vector<T> values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the value of rank ⌊share·(n − 1)⌋ in ascending order, without interpolation, for `share` in 0…1. At 0.5 and
/// an even number of values it is the *lower* of the two middle ones, unlike UpperMedian. `values` must not be empty or
/// contain NaN.
inline double LowerPercentile(std::vector<double> values, double share) {
  assert(!values.empty());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace etude
