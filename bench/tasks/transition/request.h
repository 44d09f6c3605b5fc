#pragma once

#include "bench/tasks/transition/stage.h"
#include "sim/random/stream.h"

namespace etude {

/// One trial's truth: which clip plays, which is asked for, and when.
struct SwitchRequest {
  int from = 0;
  int to = 0;
  int request_frame = 0;
};

/// The clip that plays in this trial; the stage must not be empty.
int FromClip(const Stage& stage, const WorldKey& key);

/// The error is the reason to skip this world.
Result<SwitchRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
