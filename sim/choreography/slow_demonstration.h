#pragma once

#include <string_view>

#include "engine/base/result.h"
#include "sim/choreography/move.h"

namespace etude {

/// The prefix of a demonstration's name, as in "slow_clap".
constexpr std::string_view kSlowDemonstrationPrefix = "slow_";

/// Makes the coach's slow demonstration of a move: at half the move's tempo, with a hold of one (slow) beat at every
/// key pose. The motion slows down before each hold and speeds up after it, which shows a learner the key poses. A jump
/// freezes in the air like a paused film. In the result, `beats` counts slow beats, and the key poses are at the starts
/// of the holds. Fails if the move has no key poses (an act), or if a key pose is at beat 0, where no motion leads into
/// it.
Result<Move> SlowDemonstration(const Move& move);

}  // namespace etude
