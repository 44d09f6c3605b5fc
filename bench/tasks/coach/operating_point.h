#pragma once

#include <functional>
#include <vector>

#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "engine/recognition/filters.h"

namespace etude {

/// Makes a coach who dances the whole song and judges nothing before a window has closed. Afterwards any recogniser can
/// be run on the recorded session.
Result<ReadyCoach> MakeWatching(const CoachStage& stage);

/// Runs a recogniser on a recorded session; it is asked for the same moves as in the session. Calls `judged` for every
/// performance when its window closes, with the evidence.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

/// Returns the highest threshold on evidence such that at most `needless_per_min` right performances per minute are
/// below it. `right` holds the evidence of all right performances of `minutes` > 0, in any order. Returns 1 if all of
/// them may be below.
double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min);

/// Sets CoachOptions::right_from, the evidence at or above which a performance counts as right, for methods that do not
/// set it. The value is found on sessions of other people under the same condition, who are never interrupted: the
/// given number of right performances per minute shall be taken for mistakes. `key` is that of any judged world; the
/// dice of the other people differ from those of the judged ones. Methods with an oracle for judgement, or with a
/// program as the recogniser, are not changed.
Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods);

}  // namespace etude
