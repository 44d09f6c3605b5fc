#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace etude {

/// The value of rank size/2 among the sorted ones, counted from 0: of an even number the upper of the two middle
/// values, never their mean. Needs a value; of none that is NaN.
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
