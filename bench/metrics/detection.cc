#include "bench/metrics/detection.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace etude {
namespace {

std::vector<double> TimesOf(std::string_view move, std::span<const Moment> moments) {
  std::vector<double> times;
  for (const Moment& moment : moments) {
    if (moment.move == move) times.push_back(moment.at_s);
  }
  std::ranges::sort(times);
  return times;
}

/// Returns the largest possible number of pairs. Greedy matching in order of time is optimal, because taking the
/// earliest detection that fits a point leaves the later detections for later points.
int CountPairs(const std::vector<double>& points, const std::vector<double>& detections, double tolerance_s) {
  constexpr double kRounding = 1e-9;
  int pairs = 0;
  std::size_t d = 0;
  for (const double point : points) {
    while (d < detections.size() && detections[d] < point - tolerance_s - kRounding) ++d;
    if (d == detections.size() || detections[d] > point + tolerance_s + kRounding) continue;
    ++pairs;
    ++d;
  }
  return pairs;
}

std::set<std::string> MovesOf(std::span<const Moment> points, std::span<const Moment> detections) {
  std::set<std::string> moves;
  for (const Moment& moment : points) moves.insert(moment.move);
  for (const Moment& moment : detections) moves.insert(moment.move);
  return moves;
}

}  // namespace

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

Wait AcceptanceLatency(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz) {
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

std::optional<double> MomentMatch::FScore() const {
  if (points + detections == 0) return std::nullopt;
  return 2.0 * matched / (points + detections);
}

MomentMatch MatchMoments(std::span<const Moment> points, std::span<const Moment> detections, double tolerance_s) {
  MomentMatch match{.points = static_cast<int>(points.size()), .detections = static_cast<int>(detections.size())};
  for (const std::string& move : MovesOf(points, detections)) {
    match.matched += CountPairs(TimesOf(move, points), TimesOf(move, detections), tolerance_s);
  }
  return match;
}

std::optional<double> MeanFScore(std::span<const Moment> points, std::span<const Moment> detections,
                                 double tolerance_s) {
  const std::set<std::string> moves = MovesOf(points, detections);
  if (moves.empty()) return std::nullopt;
  double sum = 0;
  for (const std::string& move : moves) {
    const auto of_move = [&](std::span<const Moment> moments) {
      std::vector<Moment> own;
      std::ranges::copy_if(moments, std::back_inserter(own), [&](const Moment& m) { return m.move == move; });
      return own;
    };
    // FScore has a value, because the move occurs among the points or the detections.
    sum += *MatchMoments(of_move(points), of_move(detections), tolerance_s).FScore();
  }
  return sum / static_cast<double>(moves.size());
}

}  // namespace etude
