#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/curves/curves.h"

namespace etude {

/// Returns `fault_found`: among performances with a fault of any size, the share that were not called right. Empty
/// without any.
std::optional<double> FaultFound(const std::vector<bool>& called);
/// Returns the share of grey performances that were called right. Empty without any.
std::optional<double> GreyCalledRight(const std::vector<bool>& called);

/// A performance of a move, and the move that a recogniser spotted most often during it.
struct NamedMove {
  std::string danced;
  std::string named;  ///< empty: no move was spotted
};

/// Returns the share of performances whose move was named correctly. Empty without performances.
std::optional<double> MoveNamed(std::span<const NamedMove> performances);

/// Returns the time from a right performance's completion until it was called right (`latency_s`). `first_right_s` is
/// the time, seconds from the session's start, at which it had passed every key pose asked for. A performance without a
/// `called_frame` is censored when its window closes. Negative if the call came before completion.
Wait WaitForPraise(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz);

/// The frames [begin, end) in which a performance is judged.
struct MoveWindow {
  std::string asked;   ///< the move that the coach asked for
  std::string danced;  ///< the move really performed; empty if none was
  int begin = 0;
  int end = 0;
};

/// Returns true if a detection of `move` at `frame` lies outside every performance of that move, asked for or
/// performed.
bool IsFalseAlarm(std::string_view move, int frame, std::span<const MoveWindow> windows);

/// One detection of a move by a recogniser.
struct MoveCall {
  std::string move;
  int frame = 0;
};

/// Returns the share of right performances in which the move asked for was called at least once. Empty without any.
std::optional<double> RightSpotted(std::span<const MoveWindow> right, std::span<const MoveCall> calls);

/// Returns `false_alarms_per_min` over the whole session, performances included. `session_s` must be positive.
double FalseAlarmsPerMinute(std::size_t alarms, double session_s);

/// The time of an action point or of a detection, seconds.
struct Moment {
  std::string move;
  double at_s = 0;
};

struct MomentMatch {
  int matched = 0, points = 0, detections = 0;

  /// Returns 2 matched / (points + detections); nothing if both are zero.
  std::optional<double> FScore() const;
};

/// Matches detections with action points of the same move that are at most `tolerance_s` away. Each point has at most
/// one detection and each detection at most one point; the number of pairs is the maximum. Further detections of the
/// same point are false positives (Fothergill et al. 2012).
MomentMatch MatchMoments(std::span<const Moment> points, std::span<const Moment> detections, double tolerance_s);

/// Returns the mean of the F-scores of the moves that occur, as in MSRC-12's paper; nothing without points and
/// detections.
std::optional<double> MeanFScore(std::span<const Moment> points, std::span<const Moment> detections,
                                 double tolerance_s);

}  // namespace etude
