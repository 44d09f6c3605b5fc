#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace etude {

/// The median: of an even number the midpoint of the two middle values. Needs a value; of none that is NaN.
inline double Median(std::vector<double> values) {
  assert(!values.empty());
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  return values.size() % 2 == 1 ? *upper : 0.5 * (*std::max_element(values.begin(), upper) + *upper);
}

/// The value below which `share` of all values lie, linear between neighbours of the sorted list (rank share·(n − 1)).
/// `share` from 0 to 1. Needs a value; of none that is NaN.
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

/// The value of rank size/2 among the sorted ones, counted from 0: of an even number the upper of the two middle
/// values, never their mean: one of the values, and cheaper than Median. Needs a value; of none that is NaN.
template <class T>
T UpperMedian(std::vector<T> values) {
  assert(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The value of rank ⌊share·(n − 1)⌋ among the sorted ones, without interpolation; at share 0.5 of an even number the
/// *lower* of the two middle values, unlike UpperMedian. `share` from 0 to 1. Needs a value; of none that is NaN.
inline double LowerPercentile(std::vector<double> values, double share) {
  assert(!values.empty());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace etude
