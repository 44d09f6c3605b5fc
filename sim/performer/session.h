#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"

namespace etude {

/// What a learner can do wrong in one performance of a move.
enum class Fault {
  kNone,           ///< right
  kHalfAmplitude,  ///< about half of every angle: the key pose is clearly missed
  kWrongSide,      ///< left and right exchanged; only moves that are not their own mirror image
  kWrongMove,      ///< another move, one that does not pass through the key poses asked for
  kSkipped,        ///< stands and waits
};

/// "none", "half_amplitude", "wrong_side", "wrong_move", "skipped".
std::string_view FaultName(Fault fault);

struct SessionOptions {
  int events = 10;
  double fault_share = 0.5;  ///< the share of events with a fault, rounded to whole events
  double rest_s = 1.5;       ///< least pause between one event's window and the next first beat; at least 1
  double skill = 1;          ///< 1 = a careful learner; 0 = one whose every deviation is twice as large
};

/// One scripted performance of a move. All times are seconds from the session's first frame.
struct SessionEvent {
  std::string move;            ///< the move asked for
  Fault fault = Fault::kNone;  ///< the truth
  std::string danced;          ///< the move really performed; empty when skipped
  double start_s = 0;          ///< the first beat
  double end_s = 0;            ///< the last beat
  double delay_s = 0;          ///< the learner's reaction time
  double tempo = 1;            ///< the learner's own speed, times the move's
  double amplitude = 1;        ///< times every angle's distance from the ready stance
  /// The first frame at which the motion has truly passed through all key poses asked for (see
  /// `FirstReached`); only `Perform` knows it, and only right events have it.
  std::optional<double> first_right_s;

  bool IsRight() const { return fault == Fault::kNone; }
  /// The event is judged from its first beat to half a second after its last (docs/metrics.md).
  double WindowEnd() const { return end_s + 0.5; }
};

struct SessionPlan {
  std::vector<SessionEvent> events;  ///< in time order; windows never overlap
  double duration_s = 0;
};

/// A session as it was truly performed: what the sensor looks at.
struct Performance {
  BodyMotion motion;                 ///< the whole session, 30 Hz, canonical body
  std::vector<SessionEvent> events;  ///< with `first_right_s`
};

/// Draws a script: which move, which fault, when. `moves` (at least one) are what may be asked for,
/// e.g. all built-in ones. A fault that a move cannot show (its mirror image is itself, or no other
/// move misses its key poses) is replaced by one that it can.
SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const SessionOptions& options);

/// Dances the script: ready stance with idle sway between events, smooth ways in and out of every
/// move, the performer's own small deviations in tempo, amplitude and in every angle. `moves` must hold every
/// move that the plan names.
Performance Perform(RandomStream& random, std::span<const Move> moves, const SessionPlan& plan,
                    const SessionOptions& options);

}  // namespace etude
