#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/recognition/learnt_model.h"

namespace etude {

struct CoachedTraining {
  int sessions = 300;  ///< number of sessions of three minutes, each with a different person
  std::uint64_t seed = 1;
  BoostingOptions boosting{.trees = 200, .rate = 0.08};
  OnProgress progress = {};  ///< called with the number of finished sessions
};

/// Trains the model of recogniser `coached`. Simulated people of all kinds and skills dance these songs with a coach
/// who never interrupts, in front of the sensors of both Kinects, with noise of various strengths. Every performance is
/// measured in its window, as the recogniser measures it in use, and the model is fitted to the truth. Grey
/// performances (neither right nor wrong) are left out. The random numbers differ from those of every scenario, so no
/// judged person is among the simulated people. Only LearntModel::asked is fitted. Fails on an unknown song.
Result<LearntModel> TrainCoached(std::span<const std::string> songs, const CoachedTraining& training);

}  // namespace etude
