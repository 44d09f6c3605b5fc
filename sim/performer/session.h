#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "sim/choreography/move.h"
#include "sim/performer/fault.h"
#include "sim/performer/person.h"
#include "sim/performer/rendition.h"
#include "sim/random/stream.h"

namespace etude {

struct SessionOptions {
  People people = People::kMixed;
  int events = 10;
  double fault_share = 0.5;             ///< share of events with a fault, rounded to whole events
  double two_faults = 0.25;             ///< probability that an event with a fault has a second fault
  std::optional<double> severity = {};  ///< severity of every fault, in [0, 1]; if empty, drawn for each fault
  std::vector<Fault> faults = {};       ///< faults that may occur; if empty, all
  double rest_s = 1.5;                  ///< minimum time from an event's WindowEnd to the next beat 0, at least 1 s
};

/// One event of a session: a scripted performance of a move. All times are in seconds from the session's first frame.
struct SessionEvent {
  std::string move;                      ///< the requested move, which the person means to dance
  std::vector<GradedFault> faults = {};  ///< faults; empty if performed as meant
  std::string danced;                    ///< the move that is danced, fully or in part; empty if none
  double start_s = 0;                    ///< time of the first requested beat
  double end_s = 0;                      ///< time of the last beat, as this person means to dance this beat
  Chance chance = {};                    ///< random variation of this performance
  PerformanceDeviation deviation;        ///< truth: deviation from what was meant
  Truth truth = Truth::kRight;           ///< the judgement that follows from `deviation`
  /// For right events only: the time at which the move's last key beat was performed. This time is computed from the
  /// timing of the choreography and of the person, not from poses.
  std::optional<double> first_right_s = {};

  bool IsRight() const { return truth == Truth::kRight; }
  /// Returns the end of the window in which the event is judged: half a second after the event's last beat
  /// (docs/reference/metrics.md).
  double WindowEnd() const { return end_s + 0.5; }
};

struct SessionPlan {
  std::vector<SessionEvent> events;  ///< events in order of time; the windows in which they are judged never overlap
  double duration_s = 0;
};

/// A session as it was truly performed. The sensor observes this motion.
struct Performance {
  Person person;
  BodyMotion motion;                 ///< the whole session at 30 Hz, with the person's body
  std::vector<SessionEvent> events;  ///< the events with their truth
};

/// Draws a script for this person: moves, faults and times. `moves` (at least one) are the moves that may be requested,
/// for example all built-in moves. If a move cannot show a drawn fault (for example the wrong side of a symmetric
/// move), another fault that it can show replaces it.
SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const Person& person,
                        const SessionOptions& options);

/// Performs the script: ready stance with sway between events, smooth blends into and out of every move, always in the
/// person's own style. `moves` must contain every move in the plan.
Performance Perform(RandomStream& random, std::span<const Move> moves, const Person& person, const SessionPlan& plan);

}  // namespace etude
