#include "engine/formats/time_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/formats/row_rates.h"

namespace etude {
namespace {

constexpr TimeUnit kSeconds{}, kHundredths = {1e-2, "hundredths of a second"};

/// Returns the unit in which a step between rows agrees with the stated rate; nullopt if there is none. A step of 1 may
/// also be a frame, if `are_whole`: all times are whole numbers.
std::optional<TimeUnit> UnitByRate(double step, double rate_hz, bool are_whole) {
  constexpr double kTolerance = 0.1;
  std::vector<TimeUnit> units = {kSeconds};
  units.insert(units.end(), std::begin(kSmallUnits), std::end(kSmallUnits));
  units.push_back(kHundredths);
  if (step == 1 && are_whole) units.push_back({1 / rate_hz, "frame numbers"});
  const auto fits = [&](const TimeUnit& unit) { return std::abs(step * unit.seconds * rate_hz - 1) < kTolerance; };
  const auto found = std::ranges::find_if(units, fits);
  return found == units.end() ? std::nullopt : std::optional(*found);
}

/// Returns the unit of times that, as seconds, have more than a second between rows; seconds for other times. The unit
/// is the largest one that gives a usual rate, or else 10 to 400 Hz, or else at least 1 Hz. `remark` states the unit,
/// its rate, and the other units that give 10 to 400 Hz.
TimeUnit UnitByStep(double step, const std::string& times, std::string& remark) {
  constexpr double kMinLikely_hz = 10, kMaxLikely_hz = 400;
  if (!(step > 1)) return kSeconds;
  const auto rate_in = [&](const TimeUnit& unit) { return 1 / (step * unit.seconds); };
  const auto is_usual = [&](const TimeUnit& unit) {
    constexpr double kNear = 0.01, kSlowSensors_hz[] = {10, 15, 20};
    const auto is_near = [&](double rate) { return std::abs(rate_in(unit) / rate - 1) < kNear; };
    return std::ranges::any_of(kUsualRates_hz, is_near) || std::ranges::any_of(kSlowSensors_hz, is_near);
  };
  const auto is_likely = [&](const TimeUnit& unit) {
    return rate_in(unit) >= kMinLikely_hz && rate_in(unit) <= kMaxLikely_hz;
  };
  const auto is_possible = [&](const TimeUnit& unit) { return rate_in(unit) >= kMinMotionRate_hz; };
  const auto* unit = std::ranges::find_if(kSmallUnits, is_usual);
  if (unit == std::end(kSmallUnits)) unit = std::ranges::find_if(kSmallUnits, is_likely);
  if (unit == std::end(kSmallUnits)) unit = std::ranges::find_if(kSmallUnits, is_possible);
  if (unit == std::end(kSmallUnits)) return kSeconds;
  std::vector<std::string> others;
  for (const TimeUnit& other : {kHundredths, kSmallUnits[0], kSmallUnits[1], kSmallUnits[2], kSmallUnits[3]}) {
    if (!is_likely(other) || other.seconds == unit->seconds) continue;
    others.push_back(fmt::format("in {}, it would be {:.4g} Hz", other.name, rate_in(other)));
  }
  remark = fmt::format(
      "{} taken as {}, because in seconds the rows would be more than a second apart; the rate is "
      "{:.4g} Hz{}",
      times, unit->name, rate_in(*unit),
      others.empty() ? "" : " (" + Join(others) + "; `--rate`, in convert `--file-rate`, sets it)");
  return *unit;
}

}  // namespace

bool NamesMinutes(std::string_view heading) {
  std::string letters = InLowerCase(std::string(heading));
  std::erase_if(letters, [](char c) { return !IsLower(c); });
  constexpr std::string_view kNames[] = {"min", "mins", "tmin"}, kEnds[] = {"timemin", "timemins", "minute", "minutes"};
  return std::ranges::count(kNames, letters) > 0 ||
         std::ranges::any_of(kEnds, [&](std::string_view end) { return letters.ends_with(end); });
}

double TimeScale::SecondsOf(double count) const {
  if (first == 0) return count * seconds;
  constexpr double kPerSecond = 1e6;  // round to microseconds: a double cannot store times since 1970 more finely
  return std::round((count - first) * seconds * kPerSecond) / kPerSecond;
}

TimeScale FindTimeScale(std::span<const double> times, const ToldRate& told) {
  constexpr double kMaxStart_s = 1e6;
  constexpr std::size_t kMinSteps = 5;  // without a stated rate
  TimeScale scale;
  // Choose the unit by the stated rate, otherwise by the median step. Without a stated rate, rows that are sent twice
  // have no step; with one, times may be rounded to whole seconds.
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (const double step = times[i] - times[i - 1]; !std::isnan(step) && (step != 0 || told.rate_hz)) {
      steps.push_back(step);
    }
  }
  const std::size_t count = steps.size();
  const double step = count == 0 ? 0 : Median(std::move(steps));
  const bool are_whole =
      std::ranges::all_of(times, [](double time) { return std::isnan(time) || time == std::floor(time); });
  const auto by_rate = told.rate_hz ? UnitByRate(step, *told.rate_hz, are_whole) : std::nullopt;
  if (by_rate) {
    scale.seconds = by_rate->seconds;
    if (by_rate->seconds != kSeconds.seconds) {
      scale.remark = fmt::format("{} is taken as {}, because the rows then have the {} of {:g} Hz", told.times,
                                 by_rate->name, told.header, *told.rate_hz);
    }
  } else if (count >= kMinSteps) {
    scale.seconds = UnitByStep(step, told.rate_hz ? told.times + " is" : "its times are", scale.remark).seconds;
  }
  // Subtract the first time if it is very large, as in times since 1970.
  const auto first = std::ranges::find_if(times, [](double time) { return !std::isnan(time); });
  if (first == times.end() || std::abs(*first * scale.seconds) <= kMaxStart_s) return scale;
  scale.first = *first;
  scale.remark += fmt::format("{}the times begin at {:.10g} s; Etude counts time from the first row",
                              scale.remark.empty() ? "" : "; ", *first * scale.seconds);
  return scale;
}

}  // namespace etude
