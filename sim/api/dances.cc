#include <etude/sim/dances.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/dance_of.h"

namespace etude::sim {
namespace {

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

std::vector<std::string> SongNames() { return BuiltinSongNames(); }

BuiltinDance DanceOfSong(const std::string& song) {
  const std::vector<std::string> names = BuiltinSongNames();
  if (std::ranges::find(names, song) == names.end()) {
    throw engine::BadInput(fmt::format("song '{}'; allowed: {}", song, Join(names)));
  }
  const Song made = engine::OrThrow(LoadBuiltinSong(song));
  BuiltinDance found{.dance = FromDance(engine::OrThrow(DanceOf(made))), .moves = {}};
  for (const Move& move : engine::OrThrow(MovesOf(made))) {
    found.moves.push_back({.name = move.name, .examples = {engine::FromBodyMotion(move.motion)}});
  }
  return found;
}

engine::BodyProportions ScenarioProportions() { return {{StandingPose().joints}, kScenarioHipHeight}; }

}  // namespace etude::sim
