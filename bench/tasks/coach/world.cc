#include "bench/tasks/coach/world.h"

#include <algorithm>
#include <cmath>

#include "bench/metrics/transition_smoothness.h"
#include "bench/tasks/detection/world.h"
#include "engine/base/angles.h"
#include "sim/choreography/dance_of.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

/// Returns the tempo at which the song contains this move, in beats of the move per minute.
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

CoachWorld MakeCoachWorld(const CoachCondition& condition, const WorldKey& key) {
  // This is about the distance at which Kinect's makers ask players to stand, metres.
  constexpr double kMinDistance = 2.5, kMaxDistance = 3.0;
  RandomStream place_dice(key, "sensor-place");
  const double drawn = place_dice.Uniform(kMinDistance, kMaxDistance);
  const DetectionOptions& sight = condition.sight;
  const SensorPlacement place{
      .distance = sight.distance_m.value_or(drawn), .turn = Radians(sight.turn_deg), .height = sight.sensor_height_m};
  CoachWorld world{.key = key,
                   .person = DrawPerson(key, sight.session.people),
                   .sensor = SkeletonSensorAt(place, sight.sensor.view),
                   .errors = sight.sensor,
                   .occluders = {},
                   .music = condition.music,
                   .frames = static_cast<int>(std::lround(condition.session_s * kJudgedRateHz)),
                   .learner = condition.learner};
  if (sight.has_cameras) world.cameras = sight.cameras.studio;
  world.errors.strength = sight.noise;
  world.occluders = MakeOccluders(sight.occluder, place, static_cast<std::size_t>(world.frames));
  return world;
}

}  // namespace etude
