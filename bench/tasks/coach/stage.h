#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/coaching/dance_library.h"
#include "engine/recognition/taught_move.h"
#include "sim/choreography/move.h"
#include "sim/performer/rendition.h"

namespace etude {

/// What all worlds of a condition share: the song as a dance, and its moves.
struct CoachStage {
  std::vector<Move> moves;                   ///< of the dance, in its order, at the song's tempo
  std::vector<TaughtMove> taught;            ///< the same, as recognisers are taught them
  std::unique_ptr<ShowableFaults> showable;  ///< what can go wrong with each of them; never null
  std::unique_ptr<DanceLibrary> library;     ///< never null
  std::vector<double> natural_jumps_cm;      ///< of the unbroken dance

  const Dance& dance() const { return library->dance(); }
};

/// Of a built-in song.
Result<CoachStage> SetCoachStage(const std::string& song);

}  // namespace etude
