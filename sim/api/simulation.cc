#include <etude/simulation.h>

#include <algorithm>
#include <cmath>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "sim/choreography/dance_of.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude::sim {
namespace {

using engine::BadInput;

SkeletonSensorOptions ErrorsOf(const SensorOptions& options) {
  if (!(options.strength >= 0 && options.strength <= 10)) {
    throw BadInput(fmt::format("strength {}; allowed: 0 to 10", options.strength));
  }
  const auto preset = FindSensorPreset(options.sensor);
  SkeletonSensorOptions errors = preset ? *preset : engine::OrThrow(ReadSensorFile(options.sensor, "sensor"));
  errors.strength = options.strength;
  return errors;
}

SensorPlace PlaceOf(const SensorOptions& options) {
  if (!(options.distance_m >= 0.4 && options.distance_m <= 20) || !(options.height_m >= 0 && options.height_m <= 10) ||
      !std::isfinite(options.turn_rad)) {
    throw BadInput(fmt::format("a sensor {} m away, {} m high, turned by {}; allowed: 0.4 to 20, 0 to 10, finite",
                               options.distance_m, options.height_m, options.turn_rad));
  }
  return {.distance = options.distance_m, .turn = options.turn_rad, .height = options.height_m};
}

engine::DanceMove FromMove(const DanceMove& move) {
  return {move.name, move.hint, {move.key_pose.joints}, engine::FromBodyMotion(move.slow)};
}

engine::Dance FromDance(const Dance& dance) {
  engine::Dance made{.title = dance.title, .motion = engine::FromBodyMotion(dance.motion)};
  std::ranges::transform(dance.moves, std::back_inserter(made.moves), FromMove);
  for (const Repetition& each : dance.repetitions) made.repetitions.push_back({each.move, each.first, each.end});
  for (const MusicTag& tag : dance.tags) made.tags.push_back({tag.frame, tag.music_s});
  for (const CoachAct& act : dance.acts) made.acts.push_back({act.name, engine::FromBodyMotion(act.motion), act.loops});
  return made;
}

}  // namespace

std::vector<engine::SensedPose> Sense(const engine::Motion& motion, const SensorOptions& options) {
  const SkeletonSensorOptions errors = ErrorsOf(options);
  const Camera sensor = SkeletonSensorAt(PlaceOf(options), errors.view);
  const WorldKey world{.suite_seed = options.seed, .scenario = "sensor", .trial = 0};
  std::vector<engine::SensedPose> sensed;
  for (const SensedFrame& frame : SenseSkeleton(engine::ToBodyMotion(motion), sensor, {}, errors, world).frames) {
    engine::SensedPose& pose = sensed.emplace_back();
    pose.body_seen = frame.body_seen;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      pose.pose.joints[i] = frame.joints[i].position;
      pose.seen[i] = static_cast<engine::Seen>(frame.joints[i].state);
    }
  }
  return sensed;
}

std::vector<std::string> SongNames() { return BuiltinSongNames(); }

BuiltinDance DanceOfSong(const std::string& song) {
  const std::vector<std::string> names = BuiltinSongNames();
  if (std::ranges::find(names, song) == names.end()) {
    throw BadInput(fmt::format("song '{}'; allowed: {}", song, Join(names)));
  }
  const Song made = engine::OrThrow(LoadBuiltinSong(song));
  BuiltinDance found{.dance = FromDance(engine::OrThrow(DanceOf(made))), .moves = {}};
  for (const Move& move : engine::OrThrow(MovesOf(made))) {
    found.moves.push_back({.name = move.name, .examples = {engine::FromBodyMotion(move.motion)}});
  }
  return found;
}

}  // namespace etude::sim
