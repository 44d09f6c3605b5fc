#pragma once

#include <functional>

#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "engine/recognition/filters.h"

namespace etude {

/// A coach who dances the whole song and says nothing before a window has closed: what he sees, any recogniser may be
/// asked about afterwards.
Result<ReadyCoach> MakeWatching(const CoachStage& stage);

/// Has a recogniser see a session once more, asked what it was asked then; `judged` gets every performance when its
/// window closes, and the evidence.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

}  // namespace etude
