#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/recognition/taught_move.h"
#include "sim/choreography/song.h"

namespace etude {

/// Makes the dance of a song as a coach needs it: with the slow demonstrations of its moves, at their own tempo, the
/// acts, and hints. The moves are in the order of their first turn.
Result<Dance> DanceOf(const Song& song);

/// Returns the moves of a song at its tempo, in the order of their first turn.
Result<std::vector<Move>> MovesOf(const Song& song);

/// Describes a move's key poses in words, by the person's own sides: "left arm up, right elbow bent". What both sides
/// share is said once: "both arms up".
std::string HintOf(const Move& move);

/// Reads the beats of a piece of music, seconds from its beginning: a number at the beginning of each line, as beat
/// trackers and Audacity's label tracks write them; the rest of the line is ignored, as are empty lines and those that
/// begin with '#'. Refused, with file and line: what is no number, beats that do not ascend, neighbours that are
/// under 0.2 or over 3 s apart, fewer than 8, more than 10,000.
Result<std::vector<double>> ReadBeats(std::string_view text, const std::string& file);

/// Computes the tempo from the median interval of at least two beats: beats a minute, to a hundredth.
double TempoOf(const std::vector<double>& beats_s);

/// Moves the dance of a song to given beats: tag by tag it belongs to the moment at which its beat sounds. Fails where
/// the dance takes more beats than there are.
Result<Dance> ToBeats(Dance dance, const std::vector<double>& beats_s);

/// A move as recognisers are taught it: its key poses, and the motion itself as an example.
TaughtMove TaughtOf(const Move& move);

}  // namespace etude
