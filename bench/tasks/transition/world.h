#pragma once

#include "bench/tasks/transition/stage.h"
#include "engine/transitions/transition_record.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the clip that plays in this trial; the stage must not be empty.
int FromClip(const Stage& stage, const WorldKey& key);

/// Draws one trial: the clip that plays, the requested clip, and the time of the request. The method sets the waiting
/// time. An error is the reason why this world is skipped.
Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
