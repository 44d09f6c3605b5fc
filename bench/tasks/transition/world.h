#pragma once

#include "bench/tasks/transition/stage.h"
#include "engine/transitions/transition_record.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the index of the clip that plays in this trial. The stage must contain clips.
int FromClip(const Stage& stage, const WorldKey& key);

/// Draws one trial: the clip that plays, the requested clip, and the time of the request. The method will set the
/// waiting time. If this fails, the error is the reason why the world is skipped.
Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
