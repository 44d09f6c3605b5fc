#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// An event is one scripted performance of a move that was truly right or wrong (docs/metrics.md); grey ones are none.
/// Positive = "right".
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

/// Empty when nothing was called right.
std::optional<double> Precision(const Confusion& confusion);
/// Empty when nothing was right.
std::optional<double> Recall(const Confusion& confusion);
/// Of performances with a fault, however slight, by whether each was called right: the share that was not. Empty when
/// there are none.
std::optional<double> FaultFound(const std::vector<bool>& called);
/// 2 TP / (2 TP + FP + FN); empty when nothing was right and nothing was called so.
std::optional<double> F1(const Confusion& confusion);

/// The chance that a right event scores higher than a wrong one, ties counting half (Mann–Whitney).
/// Empty when all events are right or none is.
std::optional<double> RocAuc(std::span<const JudgedEvent> events);

/// The strictest threshold on scores at which this share of the right events, in (0, 1], is called right. Empty when
/// none is right.
std::optional<double> ThresholdAtRecall(std::span<const JudgedEvent> events, double recall);

/// Of grey performances, by whether each was called right: the share that was. Empty when there are none.
std::optional<double> GreyCalledRight(const std::vector<bool>& called);

/// A performance in which a move was danced, and the move that a recogniser spotted there most.
struct NamedMove {
  std::string danced;
  std::string named;  ///< empty: none
};

/// The share of performances whose move was named; empty when there are none.
std::optional<double> MoveNamed(std::span<const NamedMove> performances);

/// A time until something happened, or until it was given up waiting for.
struct Wait {
  double seconds = 0;
  bool happened = false;  ///< false: censored, it took longer than `seconds`
};

/// How long a right performance waited to be called right (`latency_s`). `first_right_s` is when it had truly passed
/// through every key pose asked for, seconds from the session's start; a performance that was not called (no
/// `called_frame`) was waited for until its window closed. Negative when it was called before it was finished.
Wait WaitForPraise(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz);

/// The median waiting time with censored waits (Kaplan and Meier 1958): the first time at which the
/// estimated share still waiting is ½ or less. Empty when it never is.
std::optional<double> KaplanMeierMedian(std::span<const Wait> waits);

/// The frames [begin, end) in which a performance is judged.
struct MoveWindow {
  std::string asked;   ///< the move that the coach asked for
  std::string danced;  ///< the move really performed; empty when none was
  int begin = 0;
  int end = 0;
};

/// Whether a recogniser that fires for `move` at `frame` does so outside every performance of that move, asked for or
/// performed.
bool IsFalseAlarm(std::string_view move, int frame, std::span<const MoveWindow> windows);

/// A recogniser took a move for performed.
struct MoveCall {
  std::string move;
  int frame = 0;
};

/// The share of right performances in which the move asked for was called at least once. Empty when there are none.
std::optional<double> RightSpotted(std::span<const MoveWindow> right, std::span<const MoveCall> calls);

/// `false_alarms_per_min`, over the whole session, performances included: needs a session longer than nothing.
double FalseAlarmsPerMinute(std::size_t alarms, double session_s);

}  // namespace etude
