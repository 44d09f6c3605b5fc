#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude {

/// How a file counts time.
struct TimeScale {
  double first = 0;         ///< the count that becomes 0 s
  double seconds = 1;       ///< seconds per count
  std::string remark = "";  ///< what was concluded, for people; "" if the file counts seconds from near 0

  /// Returns a count in seconds; where `first` is not 0, to the microsecond.
  double SecondsOf(double count) const;
};

/// The rate that a header states, if any, the header's name, and the name of the times that it is compared with.
struct ToldRate {
  std::optional<double> rate_hz = {};
  std::string header = "";
  std::string times = "the column Time";
};

/// Finds the scale of a file's times (NaN: none). They are milli-, micro- or nanoseconds, not seconds, if this agrees
/// with the stated rate, or if rows would be more than a second apart without a stated rate. Times that begin beyond
/// 11 days, such as those since 1970, count from the first.
TimeScale FindTimeScale(std::span<const double> times, const ToldRate& told);

}  // namespace etude
