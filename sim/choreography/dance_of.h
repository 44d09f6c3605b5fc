#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/recognition/taught_move.h"
#include "sim/choreography/song.h"

namespace etude {

/// Makes the dance of a song in the form that a coach needs: with acts, hints, and slow demonstrations of the moves at
/// half of each move's own tempo. The moves are in the order of first appearance.
Result<Dance> DanceOf(const Song& song);

/// Returns the moves of a song at the song's tempo, in the order of first appearance.
Result<std::vector<Move>> MovesOf(const Song& song);

/// Describes a move's key poses in words. Left and right are the person's own: "left arm up, right elbow bent". If the
/// two sides have the same description, the sides are combined: "both arms up".
std::string HintOf(const Move& move);

/// Reads the times of the beats of a piece of music, seconds from the beginning of the music. Each line begins with a
/// number, as in the output of beat trackers and in Audacity's label tracks; the rest of the line is ignored. Empty
/// lines and lines that begin with '#' are skipped. Fails, with file and line, at a line that does not begin with a
/// number of at least 0, at a beat that is less than 0.2 s or more than 3 s after the previous beat, and at beat
/// 10,001. Fails, with the file, if there are fewer than 8 beats.
Result<std::vector<double>> ReadBeats(std::string_view text, const std::string& file);

/// Returns the tempo of at least two beats: 60 s divided by the upper median of the intervals between the beats, in
/// beats a minute, rounded to 0.01.
double TempoOf(const std::vector<double>& beats_s);

/// Aligns the dance of a song with given beats: every music tag moves to the time of its beat, interpolated between
/// beats. Fails if the dance needs more beats than are given.
Result<Dance> ToBeats(Dance dance, const std::vector<double>& beats_s);

/// Returns a move in the form in which recognisers are taught: its key poses, and its motion as an example.
TaughtMove TaughtOf(const Move& move);

}  // namespace etude
