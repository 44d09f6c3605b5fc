#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/curves/curves.h"

namespace etude {

/// Of performances with a fault, however slight, by whether each was called right: the share that was not. Empty when
/// there are none.
std::optional<double> FaultFound(const std::vector<bool>& called);
/// Of grey performances, by whether each was called right: the share that was. Empty when there are none.
std::optional<double> GreyCalledRight(const std::vector<bool>& called);

/// A performance in which a move was danced, and the move that a recogniser spotted there most.
struct NamedMove {
  std::string danced;
  std::string named;  ///< empty: none
};

/// The share of performances whose move was named; empty when there are none.
std::optional<double> MoveNamed(std::span<const NamedMove> performances);

/// How long a right performance waited to be called right (`latency_s`). `first_right_s` is when it had truly passed
/// through every key pose asked for, seconds from the session's start; a performance that was not called (no
/// `called_frame`) was waited for until its window closed. Negative when it was called before it was finished.
Wait WaitForPraise(double first_right_s, std::optional<int> called_frame, int window_end_frame, double rate_hz);

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
