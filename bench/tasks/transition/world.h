#pragma once

#include "bench/tasks/transition/stage.h"
#include "engine/transitions/transition_record.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the clip that plays in this trial; the stage must not be empty.
int FromClip(const Stage& stage, const WorldKey& key);

/// Draws one trial: which clip plays, which one is requested, and when. The budget is left to the method. The error is
/// the reason to skip this world.
Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
