#include <etude/sim/dances.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/api/checks.h"
#include "engine/base/names.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/dance_of.h"

namespace etude::sim {

std::vector<std::string> SongNames() { return BuiltinSongNames(); }

BuiltinDance DanceOfSong(const std::string& song) {
  const std::vector<std::string> names = BuiltinSongNames();
  if (std::ranges::find(names, song) == names.end()) {
    throw engine::BadInput(fmt::format("song '{}'; allowed: {}", song, Join(names)));
  }
  const Song made = engine::OrThrow(LoadBuiltinSong(song));
  BuiltinDance found{.dance = engine::OrThrow(DanceOf(made)), .moves = {}};
  for (const Move& move : engine::OrThrow(MovesOf(made))) {
    found.moves.push_back({.name = move.name, .examples = {StreamOf(move.motion)}});
  }
  return found;
}

engine::BodyProportions ScenarioProportions() { return {StandingPose(), kScenarioHipHeight}; }

}  // namespace etude::sim
