#include "engine/formats/time_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/order_statistics.h"

namespace etude {

double TimeScale::SecondsOf(double count) const {
  if (first == 0) return count * seconds;
  constexpr double kPerSecond = 1e6;  // round to microseconds: a double cannot store times since 1970 more finely
  return std::round((count - first) * seconds * kPerSecond) / kPerSecond;
}

TimeScale FindTimeScale(std::span<const double> times, const ToldRate& told) {
  constexpr double kTolerance = 0.1, kMaxStart_s = 1e6;
  constexpr std::size_t kMinSteps = 5;
  constexpr std::pair<double, const char*> kUnits[] = {
      {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}};
  TimeScale scale;
  // Choose the unit in which the median step agrees with the stated rate or, without a rate, is at most a second.
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (const double step = times[i] - times[i - 1]; !std::isnan(step)) steps.push_back(step);
  }
  if (steps.size() >= (told.rate_hz ? 1 : kMinSteps)) {
    const double step = Median(std::move(steps));
    const auto* const unit = std::ranges::find_if(kUnits, [&](const auto& one) {
      return told.rate_hz ? std::abs(step * one.first * *told.rate_hz - 1) < kTolerance
                          : step > 1 && step * one.first <= 1;
    });
    if (unit != std::end(kUnits)) {
      scale.seconds = unit->first;
      scale.remark = told.rate_hz
                         ? fmt::format("{} is taken as {}, because the rows then have the {} of {:g} Hz", told.times,
                                       unit->second, told.header, *told.rate_hz)
                         : fmt::format("its times are taken as {}: as seconds, rows would be more than a second apart",
                                       unit->second);
    }
  }
  // Subtract the first time if it is very large, as in times since 1970.
  const auto first = std::ranges::find_if(times, [](double time) { return !std::isnan(time); });
  if (first == times.end() || std::abs(*first * scale.seconds) <= kMaxStart_s) return scale;
  scale.first = *first;
  scale.remark += fmt::format("{}its times begin at {:.10g} s: they are counted from its first row",
                              scale.remark.empty() ? "" : "; ", *first * scale.seconds);
  return scale;
}

}  // namespace etude
