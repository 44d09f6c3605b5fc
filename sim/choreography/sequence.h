#pragma once

#include <span>

#include "sim/choreography/controls.h"
#include "sim/choreography/move.h"

namespace etude {

/// A stretch of music that one dancer fills with repetitions of one move, or by waiting.
struct Turn {
  double start_beat = 0;
  double beats = 2;            ///< at least the two blends together
  const Move* move = nullptr;  ///< null: waits in the ready stance, knees giving way between the beats
  double pace = 1;             ///< beats of the move per beat of the music
};

/// The body passes from one turn to the next from so many beats before the change to so many after it: a dancer thinks
/// ahead, and the first key pose of a move may come early.
constexpr double kBlendBeatsBefore = 1, kBlendBeatsAfter = 0.5;

/// The body at a beat of the music, turns flowing into each other: in the blend both are danced, the one beyond its
/// last beat and the other before its first, and the share of the next one grows. Feet do not take part: all moves have
/// them home at their beat 0, where they change over at once, so that a foot which stands, stands. `turns` (at least
/// one) follow each other without gaps; before the first and after the last the body comes to rest.
Controls SequenceAt(std::span<const Turn> turns, double beat);

}  // namespace etude
