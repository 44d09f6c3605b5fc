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
  double fault_share = 0.5;             ///< the share of events with a fault, rounded to whole events
  double two_faults = 0.25;             ///< the chance that an event with a fault has a second one
  std::optional<double> severity = {};  ///< of every fault, in [0, 1]; else thrown evenly for each
  std::vector<Fault> faults = {};       ///< those that may happen; none: all
  double rest_s = 1.5;                  ///< least pause between one event's window and the next first beat; at least 1
};

/// A scripted performance of a move. All times are seconds from the session's first frame.
struct SessionEvent {
  std::string move;                      ///< asked for, and meant
  std::vector<GradedFault> faults = {};  ///< none: performed as meant
  std::string danced;                    ///< the move that is truly danced, in whole or in part; empty: none at all
  double start_s = 0;                    ///< the first beat asked for
  double end_s = 0;                      ///< the last beat, as this person means to dance it
  Chance chance = {};                    ///< the luck of this performance
  Stray stray;                           ///< truth: from what was meant
  Truth truth = Truth::kRight;           ///< what follows from `stray`
  /// The time at which the move's last key beat was performed, for right events only: by the clocks of the choreography
  /// and of the person, not by any pose.
  std::optional<double> first_right_s = {};

  bool IsRight() const { return truth == Truth::kRight; }
  /// Returns the end of the time in which the event is judged: half a second after its last beat
  /// (docs/reference/metrics.md).
  double WindowEnd() const { return end_s + 0.5; }
};

struct SessionPlan {
  std::vector<SessionEvent> events;  ///< in time order; windows never overlap
  double duration_s = 0;
};

/// A session as it was truly performed, which the sensor looks at.
struct Performance {
  Person person;
  BodyMotion motion;                 ///< the whole session, 30 Hz, the person's body
  std::vector<SessionEvent> events;  ///< with their truth
};

/// Draws a script for this person: which move, which faults, when. `moves` (at least one) are what may be asked for,
/// e.g. all built-in ones. A fault that a move cannot show (its mirror image is itself) is replaced by one that it can.
SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const Person& person,
                        const SessionOptions& options);

/// Dances the script: ready stance with idle sway between events, smooth ways in and out of every
/// move, the person's own ways throughout. `moves` must hold every move that the plan names.
Performance Perform(RandomStream& random, std::span<const Move> moves, const Person& person, const SessionPlan& plan);

}  // namespace etude
