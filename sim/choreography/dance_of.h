#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/recognition/taught_move.h"
#include "sim/choreography/song.h"

namespace etude {

/// A song as a coach needs it: with the slow demonstrations of its moves, at their own tempo, the acts, and hints. The
/// moves are in the order of their first turn.
Result<Dance> DanceOf(const Song& song);

/// The moves of a song as it has them danced, at its tempo; in the order of their first turn.
Result<std::vector<Move>> MovesOf(const Song& song);

/// A move's key poses in words, as the person's own sides: "left arm up, right elbow bent". What both sides share is
/// said once: "both arms up".
std::string HintOf(const Move& move);

/// A move as recognisers are taught it: its key poses, and the motion itself as an example.
TaughtMove TaughtOf(const Move& move);

}  // namespace etude
