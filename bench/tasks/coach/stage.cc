#include "bench/tasks/coach/stage.h"

#include <algorithm>

#include "bench/metrics/transition_smoothness.h"
#include "sim/choreography/dance_of.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

/// How fast the song has this move danced, beats of the move per minute.
double TempoOf(const Song& song, const std::string& move) {
  const auto part = std::ranges::find(song.parts, move, &SongPart::move);
  return part->half_time ? song.tempo_bpm / 2 : song.tempo_bpm;
}

}  // namespace

Result<CoachStage> SetCoachStage(const std::string& name) {
  ASSIGN_OR_RETURN(const Song song, LoadBuiltinSong(name));
  ASSIGN_OR_RETURN(Dance dance, DanceOf(song));
  CoachStage stage;
  for (const DanceMove& danced : dance.moves) {
    ASSIGN_OR_RETURN(const Move move, LoadBuiltinMove(danced.name));
    ASSIGN_OR_RETURN(Move at_tempo, AtTempo(move, TempoOf(song, danced.name), {}));
    stage.taught.push_back(TaughtOf(at_tempo));
    stage.moves.push_back(std::move(at_tempo));
  }
  stage.showable = std::make_unique<ShowableFaults>(stage.moves);
  stage.natural_jumps_cm = NaturalJumpsCm(dance.motion);
  ASSIGN_OR_RETURN(auto library, DanceLibrary::Make(std::move(dance)));
  stage.library = std::make_unique<DanceLibrary>(std::move(library));
  return stage;
}

}  // namespace etude
