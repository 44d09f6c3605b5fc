#pragma once

#include <string_view>

#include "engine/base/result.h"
#include "sim/choreography/move.h"

namespace etude {

/// A demonstration is named after its move: "slow_clap".
constexpr std::string_view kSlowDemonstrationPrefix = "slow_";

/// Makes the coach's slow demonstration of a move: at half its tempo, every key pose held for one (slow) beat, slowing
/// down into it and gathering way out of it, so that a learner sees what is asked. A jump hangs in the air, as in a
/// film that is stopped. Its beats are the slow ones; its key poses are the move's, at the beginning of their hold.
/// Fails for what has no key poses (an act), or has one at its very first beat, where nothing leads into it.
Result<Move> SlowDemonstration(const Move& move);

}  // namespace etude
