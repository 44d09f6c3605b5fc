#pragma once

#include <functional>
#include <string_view>

#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "engine/recognition/filters.h"

namespace etude {

/// A coach who says nothing before a window has closed, and dances the whole song unless the policy is told the truth:
/// what he sees, any recogniser may be asked about afterwards.
Result<ReadyCoach> MakeWatching(const CoachStage& stage, std::string_view policy = "never");

/// Has a recogniser see a session once more, asked what it was asked then; `judged` gets every performance when its
/// window closes, and the evidence.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

}  // namespace etude
