#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace etude {

/// part / whole; empty when there is nothing to be a share of.
inline std::optional<double> Share(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// An event is one scripted performance of a move that was truly right or wrong (docs/reference/metrics.md); grey ones
/// are none. Positive = "right".
struct JudgedEvent {
  bool is_right = false;      ///< the truth
  bool called_right = false;  ///< what the recogniser said by the end of the event's window
  double score = 0;           ///< the recogniser's soft answer, higher = righter
};

struct Confusion {
  int true_positives = 0;
  int false_positives = 0;
  int false_negatives = 0;
  int true_negatives = 0;
};

Confusion CountConfusion(std::span<const JudgedEvent> events);

/// TP / (TP + FP); empty when nothing was called right.
std::optional<double> PrecisionOf(const Confusion& confusion);
/// TP / (TP + FN); empty when nothing was right.
std::optional<double> RecallOf(const Confusion& confusion);
/// 2 TP / (2 TP + FP + FN); empty when nothing was right and nothing was called so.
std::optional<double> F1(const Confusion& confusion);

/// The chance that a right event scores higher than a wrong one, ties counting half (Mann–Whitney): the area under the
/// ROC curve. Empty when all events are right or none is.
std::optional<double> RocAuc(std::span<const JudgedEvent> events);

/// The strictest threshold on scores at which this share of the right events, in (0, 1], is called right. Empty when
/// none is right.
std::optional<double> ThresholdAtRecall(std::span<const JudgedEvent> events, double recall);

/// The receiver operating characteristic: (share of wrong events let through, share of right ones), from (0, 0) to
/// (1, 1), equal scores in one step. Empty without a right or a wrong one.
std::vector<std::pair<double, double>> RocCurve(std::span<const JudgedEvent> events);

/// The point of the ROC at which the events were called. Empty without a right or a wrong one.
std::optional<std::pair<double, double>> OperatedAt(std::span<const JudgedEvent> events);

/// The largest F1 that any threshold on the scores reaches: what the scores are worth, whatever threshold was set.
/// Empty without a right or a wrong event.
std::optional<double> BestF1(std::span<const JudgedEvent> events);

/// A value and its 95 % interval.
struct WithInterval {
  double value = 0, low = 0, high = 0;
};

/// The area under the ROC of all events with an interval over the groups that they came from: jackknife, one group left
/// out at a time (Efron and Tibshirani 1993, chapter 11), ± 1.96 standard errors, within [0, 1]. `groups` holds the
/// group of each event. Empty without an area, or when a single group holds all right or all wrong events.
std::optional<WithInterval> JackknifedAuc(std::span<const JudgedEvent> events, std::span<const int> groups);

/// A time until something happened, or until it was given up waiting for.
struct Wait {
  double seconds = 0;
  bool happened = false;  ///< false: censored, it took longer than `seconds`, which may be infinite
};

/// The estimated share still waiting (Kaplan and Meier 1958): (time, share) after each time at which a wait ended,
/// after (the earliest time, 1). What was given up is at risk until then, and after what happens at the same time.
/// Empty without waits.
std::vector<std::pair<double, double>> SurvivalCurve(std::span<const Wait> waits);

/// The median waiting time: the first time at which the survival curve is ½ or less. Empty when it never is.
std::optional<double> KaplanMeierMedian(std::span<const Wait> waits);

}  // namespace etude
