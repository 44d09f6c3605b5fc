#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace etude {

/// A unit in which files count time.
struct TimeUnit {
  double seconds = 1;
  const char* name = "seconds";
};
/// The units of clocks that count in small steps, the largest first.
inline constexpr TimeUnit kSmallUnits[] = {
    {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-7, "ticks of 100 ns"}, {1e-9, "nanoseconds"}};

/// The origin and the unit of a file's times.
struct TimeScale {
  double first = 0;         ///< the time in the file that becomes 0 s
  double seconds = 1;       ///< seconds per unit of the file's times
  std::string remark = "";  ///< what was concluded, for users; "" if the file counts seconds from near 0

  /// Converts a time of the file to seconds since `first`. If `first` is not 0, the result is rounded to microseconds.
  double SecondsOf(double count) const;
};

/// A rate that a header may state, and, for messages, the names of this header and of the times.
struct ToldRate {
  std::optional<double> rate_hz = {};
  std::string header = "";
  std::string times = "the column Time";
};

/// Finds the origin and unit of a file's times (NaN: missing). The unit is the second, with two exceptions. (1) If the
/// times agree with the stated rate only in another unit (milli-, micro- or nanoseconds, ticks of 100 ns, hundredths of
/// a second, frames), that unit is taken. (2) If the times agree with the stated rate in no unit, or no rate is stated,
/// and if in seconds six or more rows would be more than a second apart, the unit is the one that gives a usual rate,
/// or else 10 to 400 Hz, or else at least 1 Hz. If the first time is beyond ±10⁶ s (as times since 1970 are), it
/// becomes 0 s.
TimeScale FindTimeScale(std::span<const double> times, const ToldRate& told);

constexpr double kMinute_s = 60;
/// Returns true if the heading of a column of times names minutes, as in "time_min", "Time (min)" and "minutes".
bool NamesMinutes(std::string_view heading);

}  // namespace etude
