#include "bench/metrics/detection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bench/metrics/share.h"

namespace etude {
Confusion CountConfusion(std::span<const JudgedEvent> events) {
  Confusion confusion;
  for (const JudgedEvent& event : events) {
    if (event.is_right) {
      ++(event.called_right ? confusion.true_positives : confusion.false_negatives);
    } else {
      ++(event.called_right ? confusion.false_positives : confusion.true_negatives);
    }
  }
  return confusion;
}

std::optional<double> Precision(const Confusion& confusion) {
  return Share(confusion.true_positives, confusion.true_positives + confusion.false_positives);
}

std::optional<double> Recall(const Confusion& confusion) {
  return Share(confusion.true_positives, confusion.true_positives + confusion.false_negatives);
}

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

std::optional<double> F1(const Confusion& confusion) {
  const int doubled = 2 * confusion.true_positives;
  return Share(doubled, doubled + confusion.false_positives + confusion.false_negatives);
}

std::optional<double> RocAuc(std::span<const JudgedEvent> events) {
  std::vector<JudgedEvent> sorted(events.begin(), events.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const JudgedEvent& a, const JudgedEvent& b) { return a.score < b.score; });

  // Walks up through groups of equal score; each right event beats the wrong ones below its group
  // and half of those inside.
  double right = 0, wrong_below = 0, won = 0;
  for (std::size_t begin = 0; begin < sorted.size();) {
    double group_right = 0, group_wrong = 0;
    std::size_t end = begin;
    for (; end < sorted.size() && sorted[end].score == sorted[begin].score; ++end) {
      ++(sorted[end].is_right ? group_right : group_wrong);
    }
    won += group_right * (wrong_below + 0.5 * group_wrong);
    right += group_right;
    wrong_below += group_wrong;
    begin = end;
  }
  if (right == 0 || wrong_below == 0) return std::nullopt;
  return won / (right * wrong_below);
}

std::optional<double> ThresholdAtRecall(std::span<const JudgedEvent> events, double recall) {
  std::vector<double> scores;
  for (const JudgedEvent& event : events) {
    if (event.is_right) scores.push_back(event.score);
  }
  if (scores.empty()) return std::nullopt;
  std::ranges::sort(scores, std::ranges::greater());
  constexpr double kRounding = 1e-9;  // 0.9 of ten are nine
  const double needed = std::ceil(recall * static_cast<double>(scores.size()) - kRounding);
  return scores[static_cast<std::size_t>(std::max(needed, 1.0)) - 1];
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

std::optional<double> KaplanMeierMedian(std::span<const Wait> waits) {
  std::vector<Wait> sorted(waits.begin(), waits.end());
  // What happens at a time happens before what is given up at that time (the usual convention).
  std::stable_sort(sorted.begin(), sorted.end(), [](const Wait& a, const Wait& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.happened > b.happened;
  });
  double still_waiting = 1.0;
  constexpr double kRounding = 1e-12;  // ½ reached by products of fractions
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (!sorted[i].happened) continue;
    const auto at_risk = static_cast<double>(sorted.size() - i);
    still_waiting *= (at_risk - 1.0) / at_risk;
    if (still_waiting <= 0.5 + kRounding) return sorted[i].seconds;
  }
  return std::nullopt;
}

}  // namespace etude
