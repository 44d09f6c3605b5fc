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

/// Returns the highest threshold on evidence that at most `needless_per_min` right performances per minute fail to
/// reach. `right` holds the evidence for all right performances in `minutes` > 0 of sessions, in any order. Returns 1
/// if there are at most `needless_per_min` right performances per minute.
double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min);

/// Sets the threshold of each method without one: the evidence at or above which a performance counts as right. The
/// threshold is found on uninterrupted sessions of other people under the same condition (ThresholdOf): at most
/// `needless_per_min` right performances per minute are taken for mistakes. `key` is the key of any judged world; the
/// other people are drawn with random numbers of their own. Methods with an oracle for judgement, or with a program
/// as the recogniser, are not changed.
Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods);

}  // namespace etude
