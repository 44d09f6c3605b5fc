#pragma once

#include <functional>
#include <vector>

#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"
#include "engine/recognition/filters.h"

namespace etude {

/// A coach who dances the whole song and says nothing before a window has closed: what he sees, any recogniser may be
/// asked about afterwards.
Result<ReadyCoach> MakeWatching(const CoachStage& stage);

/// Has a recogniser see a session once more, asked what it was asked then; `judged` gets every performance when its
/// window closes, and the evidence.
void FollowPerformances(const SessionLog& log, const Recogniser& recogniser, const FilterOptions& filter,
                        const std::function<void(const LoggedPerformance&, double evidence)>& judged);

/// The least evidence below which at most so many right performances a minute lie; `right`: the evidence that right
/// performances came to, in any order, within `minutes` > 0. 1 where all of them may.
double ThresholdOf(std::vector<double> right, double minutes, double needless_per_min);

/// Sets from which evidence on a performance is right (CoachOptions::right_from) for methods that do not say so
/// themselves: on sessions of other people under the same condition, whom nobody interrupts, so that so many right
/// performances a minute are taken for mistakes. `key`: of any world judged; those people are keyed apart from it.
/// Methods whose judgement is told, or made by a program in the recogniser's seat, stay as they are.
Result<void> SetThresholds(const CoachCondition& condition, const CoachStage& stage, const WorldKey& key,
                           std::vector<CoachMethod>& methods);

}  // namespace etude
