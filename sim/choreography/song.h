#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/motion/body.h"
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

/// The blend from one turn to the next begins so many beats before the change and ends so many after it: a dancer
/// thinks ahead, and the first key pose of a move may come early.
constexpr double kBlendBeatsBefore = 1, kBlendBeatsAfter = 0.5;

/// Returns the body at a beat of the music, with turns that flow into each other: in the blend both are danced, the one
/// beyond its last beat and the other before its first, and the share of the next one grows. Feet do not take part: all
/// moves have them home at their beat 0, where they change over at once, so that a foot which stands, stands. `turns`
/// (at least one) follow each other without gaps; before the first and after the last the body comes to rest.
Controls SequenceAt(std::span<const Turn> turns, double beat);

/// A move's turn in a song: danced `times` times in a row.
struct SongPart {
  std::string move;
  int times = 2;
  bool half_time = false;  ///< each of the move's beats takes two of the music's
  double start_beat = 0;   ///< of the music, which begins with the song
  double beats = 0;        ///< of the music, for all repetitions
};

/// A choreography to a piece of music: 8 to 12 different moves, each at least twice in a row (paper A, 3.4), authored
/// in scenarios/choreography/songs/*.yaml. Only moves that suit the tempo: agile ones fast songs, warm-up ones slow
/// songs, or fast ones in half time.
struct Song {
  std::string name;
  double tempo_bpm = 120;
  std::vector<SongPart> parts;
  std::vector<MusicTag> tags;  ///< the frame nearest to the beginning of every repetition, in order
  BodyMotion motion;           ///< 30 Hz, from the ready stance to the ready stance, moves flowing into each other

  /// Returns the number of frames that `motion` has once it is made.
  std::size_t CountFrames() const;
};

/// Reads a song whose moves are the built-in ones; it may last ten minutes. `tempo_bpm`: other than the file's.
Result<Song> ParseSong(std::string_view yaml, const std::string& file, std::optional<double> tempo_bpm = {});
std::vector<std::string> BuiltinSongNames();
Result<Song> LoadBuiltinSong(const std::string& name, std::optional<double> tempo_bpm = {});
/// The built-in song without its tags and its motion, which takes longer to make than all else.
Result<Song> LoadBuiltinSongOutline(const std::string& name);

}  // namespace etude
