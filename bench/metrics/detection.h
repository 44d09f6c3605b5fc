#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/curves/curves.h"

namespace etude {

/// Returns `fault_found`: the share of performances with a fault, of any size, that were not called right. The result
/// is empty if there are no such performances.
std::optional<double> FaultFound(const std::vector<bool>& called);
/// Returns the share of grey performances (neither right nor wrong) that were called right. The result is empty if
/// there are no grey performances.
std::optional<double> GreyCalledRight(const std::vector<bool>& called);

/// A performance of a move, and the move for which a recogniser found the most evidence in it.
struct NamedMove {
  std::string danced;
  std::string named;  ///< the move that the recogniser found; empty if it found none
};

/// Returns the share of performances whose move was named correctly. The result is empty if there are no performances.
std::optional<double> MoveNamed(std::span<const NamedMove> performances);

/// Returns `latency_s`: the time from the completion of a right performance until it was called right. `first_right_s`
/// is the time at which the performance had passed all requested key poses, in seconds from the session's start.
/// Without a `called_frame`, the wait is censored when the window closes. The wait is negative if the call came before
/// the completion.
Wait AcceptanceLatency(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz);

/// The frames [begin, end) in which a performance is judged.
struct MoveWindow {
  std::string asked;   ///< the move that the coach asked for
  std::string danced;  ///< the move really performed; empty if none was
  int begin = 0;
  int end = 0;
};

/// Returns true if `frame` lies in no window in which `move` was requested or performed.
bool IsFalseAlarm(std::string_view move, int frame, std::span<const MoveWindow> windows);

/// One detection of a move by a recogniser.
struct MoveCall {
  std::string move;
  int frame = 0;
};

/// Returns the share of right performances in whose window the requested move was called at least once. The result is
/// empty if there are no right performances.
std::optional<double> RightSpotted(std::span<const MoveWindow> right, std::span<const MoveCall> calls);

/// Returns `false_alarms_per_min`. The whole session counts as time, including performances. `session_s` must be
/// positive.
double FalseAlarmsPerMinute(std::size_t alarms, double session_s);

/// The time of an action point or of a detection, seconds.
struct Moment {
  std::string move;
  double at_s = 0;
};

struct MomentMatch {
  int matched = 0, points = 0, detections = 0;

  /// Returns the F-score 2 · matched / (points + detections); nothing if there are neither points nor detections.
  std::optional<double> FScore() const;
};

/// Matches detections with action points of the same move that are at most `tolerance_s` away. A point is paired
/// with at most one detection, and a detection with at most one point; the number of pairs is as large as possible.
/// Further detections of a point are false positives (Fothergill et al. 2012).
MomentMatch MatchMoments(std::span<const Moment> points, std::span<const Moment> detections, double tolerance_s);

/// Returns the mean of the F-scores of all moves that occur among points or detections, as defined in MSRC-12's paper.
/// Returns nothing if there are neither points nor detections.
std::optional<double> MeanFScore(std::span<const Moment> points, std::span<const Moment> detections,
                                 double tolerance_s);

}  // namespace etude
