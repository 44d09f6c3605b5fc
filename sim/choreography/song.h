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

/// A section of the music in which one dancer repeats one move or waits.
struct Turn {
  double start_beat = 0;
  double beats = 2;            ///< length in beats of the music; at least as long as the two blends together
  const Move* move = nullptr;  ///< the move; null: waits in the ready stance, and the knees bend on every beat
  double pace = 1;             ///< beats of the move per beat of the music
};

/// The blend between two turns begins `kBlendBeatsBefore` beats before the change and ends `kBlendBeatsAfter` beats
/// after it. The blend begins early because dancers think ahead and a move's first key pose may come early.
constexpr double kBlendBeatsBefore = 1, kBlendBeatsAfter = 0.5;

/// Returns the body at a beat of the music. In the blend between two turns, both turns are danced: the first turn
/// beyond its last beat, and the second turn, with growing weight, before its first beat. Feet are not blended: they
/// change from the first turn to the second exactly at beat 0 of the second turn. At beat 0 of every move, the feet are
/// on their home spots, so a standing foot does not move. `turns` (at least one) must follow each other without gaps.
/// The body is at rest before the first turn and after the last.
Controls SequenceAt(std::span<const Turn> turns, double beat);

/// One part of a song, in which one move is danced `times` times in a row.
struct SongPart {
  std::string move;
  int times = 2;
  bool half_time = false;  ///< each beat of the move takes two beats of the music
  double start_beat = 0;   ///< beat of the song's music at which the part begins
  double beats = 0;        ///< length of all repetitions together, in beats of the music
};

/// A choreography for a piece of music: 8 to 12 different moves, each at least twice in a row (paper A, 3.4), written
/// in scenarios/choreography/songs/*.yaml. Every move must suit the tempo: agile moves are for fast songs, warm-up
/// moves are for slow songs, or for fast songs in half time.
struct Song {
  std::string name;
  double tempo_bpm = 120;
  std::vector<SongPart> parts;
  std::vector<MusicTag> tags;  ///< the frame nearest to the start of every repetition, in order
  BodyMotion motion;           ///< the whole dance at 30 Hz, from ready stance to ready stance

  /// Returns the number of frames of `motion`. The number is known even if `motion` has not been computed.
  std::size_t CountFrames() const;
};

/// Reads a song of built-in moves; it may last at most ten minutes. `tempo_bpm` overrides the file's tempo.
Result<Song> ParseSong(std::string_view yaml, const std::string& file, std::optional<double> tempo_bpm = {});
/// Returns the names of the built-in songs, sorted.
std::vector<std::string> BuiltinSongNames();
/// Loads the built-in song with this name. The error for an unknown name lists the known names. `tempo_bpm` overrides
/// the file's tempo.
Result<Song> LoadBuiltinSong(const std::string& name, std::optional<double> tempo_bpm = {});
/// Loads the built-in song without its tags and without its motion, which is the slowest part to compute.
Result<Song> LoadBuiltinSongOutline(const std::string& name);

}  // namespace etude
