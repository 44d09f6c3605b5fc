#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace etude {

/// Returns part / whole; empty if `whole` is zero.
inline std::optional<double> Share(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// A scripted performance that was truly right or wrong (docs/reference/metrics.md). Grey performances (neither right
/// nor wrong) are not events. "Right" is the positive class.
struct JudgedEvent {
  bool is_right = false;      ///< true if the performance was truly right
  bool called_right = false;  ///< true: the recogniser called it right before the end of the event's window
  double score = 0;           ///< the recogniser's soft score; higher = more likely right
};

struct Confusion {
  int true_positives = 0;
  int false_positives = 0;
  int false_negatives = 0;
  int true_negatives = 0;
};

Confusion CountConfusion(std::span<const JudgedEvent> events);

/// Returns the precision, TP / (TP + FP); empty if no event was called right.
std::optional<double> PrecisionOf(const Confusion& confusion);
/// Returns the recall, TP / (TP + FN); empty if no event was truly right.
std::optional<double> RecallOf(const Confusion& confusion);
/// Returns the F1 score, 2 TP / (2 TP + FP + FN); empty if all events were truly wrong and called wrong.
std::optional<double> F1(const Confusion& confusion);

/// Returns the area under the ROC curve: the probability that a right event scores higher than a wrong one, where ties
/// count half (Mann–Whitney). Empty if there is no right event or no wrong event.
std::optional<double> RocAuc(std::span<const JudgedEvent> events);

/// Returns the highest threshold on scores at which at least the share `recall` of the right events, in (0, 1], is
/// called right. Empty if no event is right.
std::optional<double> ThresholdAtRecall(std::span<const JudgedEvent> events, double recall);

/// Returns the receiver operating characteristic: points (share of wrong events called right, share of right events
/// called right), from (0, 0) to (1, 1). Events with equal scores make one step. Empty if there is no right event or no
/// wrong event.
std::vector<std::pair<double, double>> RocCurve(std::span<const JudgedEvent> events);

/// Returns the point of the recogniser's own decisions (`called_right`) in the ROC diagram, with RocCurve's
/// coordinates. Empty if there is no right event or no wrong event.
std::optional<std::pair<double, double>> OperatedAt(std::span<const JudgedEvent> events);

/// Returns the largest F1 score over all thresholds on the scores. Empty if there is no right event or no wrong event.
std::optional<double> BestF1(std::span<const JudgedEvent> events);

/// A value and its 95 % interval.
struct WithInterval {
  double value = 0, low = 0, high = 0;
};

/// Returns the area under the ROC of all events, with a jackknife interval that leaves out one group at a time (Efron
/// and Tibshirani 1993, chapter 11): ± 1.96 standard errors, clipped to [0, 1]. `groups` holds the group of each event.
/// Empty if there is no area, or if one group contains all right or all wrong events.
std::optional<WithInterval> JackknifedAuc(std::span<const JudgedEvent> events, std::span<const int> groups);

/// A waiting time. It ends when an event happens or when the observation stops.
struct Wait {
  double seconds = 0;
  bool happened = false;  ///< false: the wait was censored; it is longer than `seconds`, which may be infinite
};

/// Returns the Kaplan–Meier estimate (1958) of the share still waiting. The first point is (the shortest wait, 1). One
/// point (time, share) follows for each time at which an event happened. A censored wait gives no point; it counts as
/// at risk up to and including the time at which it was censored. The curve is empty if there are no waits.
std::vector<std::pair<double, double>> SurvivalCurve(std::span<const Wait> waits);

/// Returns the median waiting time: the first time at which the survival curve is ½ or less. Empty if the curve never
/// falls to ½.
std::optional<double> KaplanMeierMedian(std::span<const Wait> waits);

}  // namespace etude
