#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/dance.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

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

  /// How many frames `motion` has once it is made.
  std::size_t CountFrames() const;
};

/// Reads a song whose moves are the built-in ones; it may last ten minutes. `tempo_bpm`: other than the file's.
Result<Song> ParseSong(std::string_view yaml, const std::string& file, std::optional<double> tempo_bpm = {});
std::vector<std::string> BuiltinSongNames();
Result<Song> LoadBuiltinSong(const std::string& name, std::optional<double> tempo_bpm = {});
/// The built-in song without its tags and its motion, which takes longer to make than all else.
Result<Song> LoadBuiltinSongOutline(const std::string& name);

}  // namespace etude
