#pragma once

#include <etude/coaching.h>
#include <etude/recognition.h>
#include <etude/transitions.h>

#include <string>
#include <vector>

/// The dances that come with Etude (docs/library.md).
namespace etude::sim {

/// Returns the names of the songs that come with Etude.
ETUDE_API std::vector<std::string> SongNames();

/// A dance that is part of Etude, and its moves as they look when they are danced right.
struct BuiltinDance {
  Dance dance;
  std::vector<TaughtMove> moves;
};
/// Throws engine::BadInput for an unknown song.
ETUDE_API BuiltinDance DanceOfSong(const std::string& song);

/// Returns the body that performs the clips of scenarios; use it to get the same results as a scenario's cells.
ETUDE_API engine::BodyProportions ScenarioProportions();

}  // namespace etude::sim
