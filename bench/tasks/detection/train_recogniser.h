#pragma once

#include <cstdint>
#include <vector>

#include "bench/tasks/detection/world.h"
#include "engine/base/progress.h"
#include "engine/recognition/learnt_model.h"

namespace etude {

struct RecogniserTraining {
  int sessions = 800;  ///< every one of another person, 16 performances each; the first half teaches spotting, too
  std::uint64_t seed = 1;
  BoostingOptions asked{.trees = 300, .rate = 0.08, .takes_turns = true};
  BoostingOptions spotted{};
  OnProgress progress = {};  ///< told of sessions
};

/// Trains what `learnt` knows: simulated people perform the repertoire's moves before both sensors, at many noises,
/// turns and distances; the program that is judged measures what it sees, and the model is fitted to what they truly
/// did. Grey performances teach nothing. The worlds are keyed apart from those of every scenario, so nobody judged is
/// among them.
LearntModel TrainRecogniser(const Repertoire& repertoire, const RecogniserTraining& training);

/// Keeps the nearest of a bag's performances, nearest first, and not more than can matter.
void KeepNearest(std::vector<PerformanceMeasures>& performances);

}  // namespace etude
