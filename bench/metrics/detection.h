#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/curves/curves.h"

namespace etude {

/// The share of performances with a fault, however slight, that were not called right. Empty when
/// there are none.
std::optional<double> FaultFound(const std::vector<bool>& called);
/// The share of grey performances that were called right. Empty when there are none.
std::optional<double> GreyCalledRight(const std::vector<bool>& called);

/// A performance in which a move was danced, and the move that a recogniser spotted there most.
struct NamedMove {
  std::string danced;
  std::string named;  ///< empty: none
};

/// The share of performances whose move was named; empty when there are none.
std::optional<double> MoveNamed(std::span<const NamedMove> performances);

/// The time that a right performance waited to be called right (`latency_s`). `first_right_s` is when it had truly
/// passed through every key pose asked for, seconds from the session's start; a performance that was not called (no
/// `called_frame`) was waited for until its window closed. Negative when it was called before it was finished.
Wait WaitForPraise(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz);

/// The frames [begin, end) in which a performance is judged.
struct MoveWindow {
  std::string asked;   ///< the move that the coach asked for
  std::string danced;  ///< the move really performed; empty when none was
  int begin = 0;
  int end = 0;
};

/// True if a recogniser that fires for `move` at `frame` does so outside every performance of that move, asked for or
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

/// A moment at which something was done, or was said to be, seconds.
struct Moment {
  std::string move;
  double at_s = 0;
};

struct MomentMatch {
  int matched = 0, points = 0, detections = 0;

  /// 2 matched / (points + detections); nothing when there are neither.
  std::optional<double> FScore() const;
};

/// Matches detections with action points of their move: at most `tolerance_s` away, each point with at most one
/// detection and the other way round; as many pairs as can be. Further detections of the same point are false ones
/// (Fothergill et al. 2012).
MomentMatch MatchMoments(std::span<const Moment> points, std::span<const Moment> detections, double tolerance_s);

/// The mean over the moves that occur of their own F-scores, as MSRC-12's paper gives it.
std::optional<double> MeanFScore(std::span<const Moment> points, std::span<const Moment> detections,
                                 double tolerance_s);

}  // namespace etude
