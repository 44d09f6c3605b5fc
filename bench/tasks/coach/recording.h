#pragma once

#include "bench/model/recording.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// What a film of a session shows: tracks "coach", "truth" (the learner as danced) and "sensed"; extras: modes, what
/// was asked for and how it was judged, the coach's decisions, hints.
Recording RecordCoaching(const CoachStage& stage, const SessionLog& log);

}  // namespace etude
