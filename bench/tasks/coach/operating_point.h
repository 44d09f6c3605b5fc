#pragma once

#include <functional>
#include <vector>

#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "engine/recognition/filters.h"

namespace etude {

/// Makes a coach who dances the whole song and judges nothing before a window has closed. Any recogniser can be run
/// afterwards on the recorded session.
Result<ReadyCoach> MakeWatching(const CoachStage& stage);

/// Runs a recogniser on a recorded session. The recogniser receives the requests of the session. Calls `judged` with
/// the evidence for every performance when its window closes.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

/// Returns the highest threshold on evidence at which at most `needless_per_min` right performances per minute are
/// below it. `right` holds the evidence for all right performances in `minutes` > 0 of sessions, in any order. Returns
/// 1 if all right performances may be below the threshold.
double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min);

/// Sets CoachOptions::right_from, the evidence at or above which a performance counts as right, for methods that do not
/// set it themselves. The threshold is found on uninterrupted sessions of other people under the same condition. At
/// this threshold, as many right performances per minute are taken for mistakes as the condition states
/// (`needless_per_min`). `key` is the key of any judged world; the other people are drawn with random numbers of their
/// own. Methods with an oracle for judgement, or with a program as the recogniser, are not changed.
Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods);

}  // namespace etude
