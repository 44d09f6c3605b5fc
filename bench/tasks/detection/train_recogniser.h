#pragma once

#include <cstdint>
#include <vector>

#include "bench/tasks/detection/world.h"
#include "engine/base/progress.h"
#include "engine/recognition/learnt_model.h"

namespace etude {

struct RecogniserTraining {
  /// Number of sessions, each with a different person and 16 performances. The first half of the sessions also
  /// teaches spotting.
  int sessions = 800;
  std::uint64_t seed = 1;
  BoostingOptions asked{.trees = 300, .rate = 0.08, .takes_turns = true};
  BoostingOptions spotted{};
  OnProgress progress = {};  ///< called with the number of finished sessions
};

/// Trains the model of recogniser `learnt`. Simulated people perform the repertoire's moves in front of the sensors
/// of both Kinects. The distance and direction of the sensor vary, and so does the strength of its noise.
/// Performances are measured as the recogniser measures them in use, and the model is fitted to the truth. Grey
/// performances (neither right nor wrong) are left out. The random numbers differ from those of every scenario, so no
/// judged person is among the simulated people.
LearntModel TrainRecogniser(const Repertoire& repertoire, const RecogniserTraining& training);

/// Keeps only those performances of a bag that are nearest to the move, nearest first. The farther ones cannot
/// influence the fit.
void KeepNearest(std::vector<PerformanceMeasures>& performances);

}  // namespace etude
