#pragma once

#include "bench/tasks/transition/stage.h"
#include "engine/transitions/transition_record.h"
#include "sim/random/stream.h"

namespace etude {

/// The clip that plays in this trial; the stage must not be empty.
int FromClip(const Stage& stage, const WorldKey& key);

/// One trial's truth: which clip plays, which is asked for, and when; the budget is left to the method. The error is
/// the reason to skip this world.
Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
