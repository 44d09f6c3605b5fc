#include "engine/formats/row_rates.h"

#include <algorithm>
#include <cmath>

#include "engine/base/order_statistics.h"

namespace etude {

double FittedRate(const std::vector<double>& steps, bool only_clear_steps) {
  constexpr double kUnclear = 0.4;  // a step farther than this from a whole number of frames is unclear
  constexpr int kRounds = 4;
  constexpr double kMaxFrames = 3;
  double rate = 1 / LowerPercentile(steps, 0.5);
  for (int round = 0; round < kRounds; ++round) {
    double frames = 0, seconds = 0;
    for (const double step : steps) {
      const double count = std::round(step * rate);
      const bool is_left_out = only_clear_steps && std::abs(step * rate - count) > kUnclear;
      if (count > kMaxFrames || is_left_out) continue;
      frames += count;
      seconds += step;
    }
    if (frames > 0) rate = frames / seconds;
  }
  return rate;
}

std::optional<double> MeanStepOfBursts(std::span<const double> times) {
  constexpr double kMaxRatio = 2, kMaxBurst = 8, kMinBursts = 3, kSteady = 0.25;
  if (times.size() < 2) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const double mean = (times.back() - times.front()) / static_cast<double>(steps.size());
  if (!(mean > kMaxRatio * LowerPercentile(steps, 0.5))) return std::nullopt;
  // A burst begins after a step above the mean. From the first row of a burst to the first of a later one, whole periods
  // pass, so these rows give the rate.
  std::vector<std::size_t> firsts;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (steps[i - 1] > mean) firsts.push_back(i);
  }
  if (firsts.size() < kMinBursts) return std::nullopt;
  const auto rows = static_cast<double>(firsts.back() - firsts.front());
  const double burst = rows / static_cast<double>(firsts.size() - 1);
  const double step = (times[firsts.back()] - times[firsts.front()]) / rows;
  if (burst > kMaxBurst || std::abs(step / mean - 1) > kSteady) return std::nullopt;
  const bool is_steady = std::ranges::all_of(firsts, [&](std::size_t i) {
    const double place = (times[i] - times[firsts.front()]) / step;
    return std::abs(place - static_cast<double>(i - firsts.front())) <= burst;
  });
  return is_steady ? std::optional(step) : std::nullopt;
}

std::optional<double> RateOfUnevenRows(std::span<const double> times_s, std::optional<double> told_hz) {
  constexpr double kMaxFrames = 1;
  const auto fits = [&](double rate) {
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      const double place = (times_s[i] - times_s.front()) * rate;
      if (!(std::abs(place - static_cast<double>(i)) <= kMaxFrames)) return false;
    }
    return true;
  };
  const double mean = static_cast<double>(times_s.size() - 1) / (times_s.back() - times_s.front());
  for (const double rate : {told_hz.value_or(0), std::round(mean), mean}) {
    if (rate > 0 && fits(rate)) return rate;
  }
  return std::nullopt;
}

}  // namespace etude
