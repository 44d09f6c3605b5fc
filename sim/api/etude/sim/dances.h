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

/// A dance that comes with Etude, and its moves as they look when they are right.
struct BuiltinDance {
  engine::Dance dance;
  std::vector<engine::TaughtMove> moves;
};
/// Throws engine::BadInput for a song that there is not.
ETUDE_API BuiltinDance DanceOfSong(const std::string& song);

/// The body that performs a scenario's clips: for answers that are those of its cells.
ETUDE_API engine::BodyProportions ScenarioProportions();

}  // namespace etude::sim
