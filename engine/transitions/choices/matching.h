#pragma once

#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

// The choices that rank every pair of frames that budget and `rules.least_play_s` allow.

/// The fuzzy gate over all frames, not bridge frames alone, ranked by the point-cloud distance (PointCloudRows) over
/// `rules.window_s`; where no pair passes, through an in-between. Paper A's measure with a finer one behind it.
SwitchRecord PlanFuzzyKovar(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// Kovar, Gleicher and Pighin 2002, as one would use it without fuzzy features: the least point-cloud distance of all
/// pairs. Their threshold on it is left away, since a switch that is asked for must come.
SwitchRecord PlanPointCloud(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// Motion matching (Clavet 2016): the least distance of MotionFeatures of all pairs.
SwitchRecord PlanMotionMatching(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

/// The fuzzy similarity between motions that paper A leaves as future work, used for switching: the fuzzy gate over all
/// frames, ranked by the mean fuzzy distance over `rules.reach_s` before and as much after the pair (WindowDistance);
/// where no pair passes, through an in-between.
SwitchRecord PlanFuzzyWindow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules);

}  // namespace etude
