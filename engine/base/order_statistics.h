#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace etude {

/// Returns the value of rank size/2 in ascending order, counted from 0: for an even number of values the upper of the
/// two middle ones, never their mean. `values` must not be empty or contain NaN.
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
