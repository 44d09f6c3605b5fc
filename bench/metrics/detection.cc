#include "bench/metrics/detection.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace etude {

std::optional<double> FaultFound(const std::vector<bool>& called) {
  return Share(static_cast<int>(std::ranges::count(called, false)), static_cast<int>(called.size()));
}

std::optional<double> GreyCalledRight(const std::vector<bool>& called) {
  return Share(static_cast<int>(std::ranges::count(called, true)), static_cast<int>(called.size()));
}

std::optional<double> MoveNamed(std::span<const NamedMove> performances) {
  const auto named =
      std::ranges::count_if(performances, [](const NamedMove& each) { return each.named == each.danced; });
  return Share(static_cast<int>(named), static_cast<int>(performances.size()));
}

Wait WaitForPraise(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz) {
  return {called_frame.value_or(window_end_frame) / rate_hz - first_right_s, called_frame.has_value()};
}

std::optional<double> RightSpotted(std::span<const MoveWindow> right, std::span<const MoveCall> calls) {
  const auto is_spotted = [&](const MoveWindow& window) {
    return std::ranges::any_of(calls, [&](const MoveCall& call) {
      return call.move == window.asked && call.frame >= window.begin && call.frame < window.end;
    });
  };
  return Share(std::ranges::count_if(right, is_spotted), static_cast<std::int64_t>(right.size()));
}

bool IsFalseAlarm(std::string_view move, int frame, std::span<const MoveWindow> windows) {
  return std::none_of(windows.begin(), windows.end(), [&](const MoveWindow& window) {
    return (window.asked == move || window.danced == move) && frame >= window.begin && frame < window.end;
  });
}

double FalseAlarmsPerMinute(std::size_t alarms, double session_s) {
  constexpr double kSecondsPerMinute = 60;
  return static_cast<double>(alarms) / (session_s / kSecondsPerMinute);
}

}  // namespace etude
