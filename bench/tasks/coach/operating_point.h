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
/// be run on what it saw.
Result<ReadyCoach> MakeWatching(const CoachStage& stage);

/// Runs a recogniser on a recorded session, asked for the same moves as in the session. Calls `judged` for every
/// performance when its window closes, with the evidence.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

/// Returns the threshold on evidence below which at most `needless_per_min` right performances a minute lie. `right`
/// holds the evidence of right performances, in any order, within `minutes` > 0. Returns 1 if all of them may lie
/// below.
double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min);

/// Sets the evidence from which on a performance counts as right (CoachOptions::right_from), for methods that do not
/// set it. It is set on sessions of other people under the same condition, who are never interrupted, so that the given
/// number of right performances a minute is taken for mistakes. `key` is that of any judged world; the other people are
/// keyed apart from it. Methods whose judgement is an oracle's, or made by a program in the recogniser's seat, are not
/// changed.
Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods);

}  // namespace etude
