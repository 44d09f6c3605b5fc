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

/// A dance that is part of Etude, with its moves as a dancer without mistakes performs them.
struct BuiltinDance {
  Dance dance;
  std::vector<TaughtMove> moves;
};
/// Returns the dance of a song. Throws engine::BadInput for an unknown song.
ETUDE_API BuiltinDance DanceOfSong(const std::string& song);

/// Returns the proportions of the body that performs the clips of scenarios. With these proportions, a program gets the
/// same results as the cells of a scenario.
ETUDE_API engine::BodyProportions ScenarioProportions();

}  // namespace etude::sim
