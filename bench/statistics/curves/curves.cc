#include "bench/statistics/curves/curves.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace etude {
namespace {

/// The numbers of right and of wrong events whose score is at or above a threshold.
struct Admitted {
  int right = 0, wrong = 0;
};

/// Returns, for every threshold from the highest to the lowest, how many right and how many wrong events have a score
/// at or above it (are admitted). The first entry admits no event. Events with equal scores are admitted in one step.
std::vector<Admitted> AdmitByScore(std::span<const JudgedEvent> events) {
  std::vector<JudgedEvent> sorted(events.begin(), events.end());
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &JudgedEvent::score);
  std::vector<Admitted> admitted{{}};
  Admitted sum;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ++(sorted[i].is_right ? sum.right : sum.wrong);
    if (i + 1 == sorted.size() || sorted[i + 1].score != sorted[i].score) admitted.push_back(sum);
  }
  return admitted;
}

}  // namespace

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

std::optional<double> PrecisionOf(const Confusion& confusion) {
  return Share(confusion.true_positives, confusion.true_positives + confusion.false_positives);
}

std::optional<double> RecallOf(const Confusion& confusion) {
  return Share(confusion.true_positives, confusion.true_positives + confusion.false_negatives);
}

std::optional<double> F1(const Confusion& confusion) {
  const int doubled = 2 * confusion.true_positives;
  return Share(doubled, doubled + confusion.false_positives + confusion.false_negatives);
}

std::optional<double> RocAuc(std::span<const JudgedEvent> events) {
  std::vector<JudgedEvent> sorted(events.begin(), events.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const JudgedEvent& a, const JudgedEvent& b) { return a.score < b.score; });

  // Visit the groups of events with equal score, from the lowest score. Each right event beats the wrong events of
  // lower score, and half of the wrong events in its group.
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
  constexpr double kRounding = 1e-9;  // tolerance, so that the share 0.9 of 10 events needs exactly 9
  const double needed = std::ceil(recall * static_cast<double>(scores.size()) - kRounding);
  return scores[static_cast<std::size_t>(std::max(needed, 1.0)) - 1];
}

std::vector<std::pair<double, double>> RocCurve(std::span<const JudgedEvent> events) {
  const std::vector<Admitted> admitted = AdmitByScore(events);
  const Admitted& all = admitted.back();
  if (all.right == 0 || all.wrong == 0) return {};
  std::vector<std::pair<double, double>> curve;
  for (const Admitted& each : admitted)
    curve.emplace_back(*Share(each.wrong, all.wrong), *Share(each.right, all.right));
  return curve;
}

std::optional<std::pair<double, double>> OperatedAt(std::span<const JudgedEvent> events) {
  const Confusion confusion = CountConfusion(events);
  const auto wrong = Share(confusion.false_positives, confusion.false_positives + confusion.true_negatives);
  const auto right = RecallOf(confusion);
  if (!wrong || !right) return std::nullopt;
  return std::pair(*wrong, *right);
}

std::optional<double> BestF1(std::span<const JudgedEvent> events) {
  const std::vector<Admitted> admitted = AdmitByScore(events);
  const Admitted& all = admitted.back();
  if (all.right == 0 || all.wrong == 0) return std::nullopt;
  double best = 0;
  for (const auto& [right, wrong] : admitted) {
    best =
        std::max(best, *F1({.true_positives = right, .false_positives = wrong, .false_negatives = all.right - right}));
  }
  return best;
}

std::optional<WithInterval> JackknifedAuc(std::span<const JudgedEvent> events, std::span<const int> groups) {
  assert(events.size() == groups.size());
  const std::optional<double> value = RocAuc(events);
  if (!value) return std::nullopt;
  // Compute the area without each group in turn.
  std::vector<double> areas;
  for (const int group : std::set<int>(groups.begin(), groups.end())) {
    std::vector<JudgedEvent> others;
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (groups[i] != group) others.push_back(events[i]);
    }
    const std::optional<double> area = RocAuc(others);
    if (!area) return std::nullopt;
    areas.push_back(*area);
  }
  // Compute the jackknife's standard error.
  const auto count = static_cast<double>(areas.size());
  double mean = 0, squares = 0;
  for (const double area : areas) mean += area / count;
  for (const double area : areas) squares += (area - mean) * (area - mean);
  const double reach = 1.96 * std::sqrt((count - 1) / count * squares);
  return WithInterval{*value, std::max(0.0, *value - reach), std::min(1.0, *value + reach)};
}

std::vector<std::pair<double, double>> SurvivalCurve(std::span<const Wait> waits) {
  if (waits.empty()) return {};
  std::vector<Wait> sorted(waits.begin(), waits.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const Wait& a, const Wait& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.happened > b.happened;
  });
  std::vector<std::pair<double, double>> curve{{sorted.front().seconds, 1.0}};
  double share = 1.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (!sorted[i].happened) continue;
    const auto at_risk = static_cast<double>(sorted.size() - i);
    share *= (at_risk - 1.0) / at_risk;
    const bool ends_tie =
        i + 1 == sorted.size() || !sorted[i + 1].happened || sorted[i + 1].seconds != sorted[i].seconds;
    if (ends_tie) curve.emplace_back(sorted[i].seconds, share);
  }
  return curve;
}

std::optional<double> KaplanMeierMedian(std::span<const Wait> waits) {
  constexpr double kRounding = 1e-12;  // tolerance, because rounding may move the product of the fractions off ½
  for (const auto& [seconds, share] : SurvivalCurve(waits)) {
    if (share <= 0.5 + kRounding) return seconds;
  }
  return std::nullopt;
}

}  // namespace etude
