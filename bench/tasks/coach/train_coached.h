#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/recognition/learnt_model.h"

namespace etude {

struct CoachedTraining {
  int sessions = 300;  ///< every one of another person, three minutes each
  std::uint64_t seed = 1;
  BoostingOptions boosting{.trees = 200, .rate = 0.08};
  OnProgress progress = {};  ///< told of sessions
};

/// Trains what `coached` knows: simulated people of all kinds and skills dance these songs along with a coach who never
/// interrupts, before both sensors and at many noises; the program that is judged measures every performance in its
/// window, and the model is fitted to what was truly danced. Grey performances teach nothing. The worlds are keyed
/// apart from those of every scenario, so nobody judged is among them. `asked` alone is fitted. Refuses songs that are
/// unknown.
Result<LearntModel> TrainCoached(std::span<const std::string> songs, const CoachedTraining& training);

}  // namespace etude
