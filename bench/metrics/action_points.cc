#include "bench/metrics/action_points.h"

#include <algorithm>
#include <cmath>
#include <set>

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

/// As many pairs as can be: the earliest detection that a point can have is never worth more to a later point.
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
    sum += *MatchMoments(of_move(points), of_move(detections), tolerance_s).FScore();  // every move here occurs
  }
  return sum / static_cast<double>(moves.size());
}

}  // namespace etude
