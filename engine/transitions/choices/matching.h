#pragma once

#include "engine/base/settings.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

// The choices that rank every pair of frames that the budget and `least_play_s` allow (AllowedAnyFrames).

struct PointCloudOptions {
  /// The length of motion that a cloud holds, seconds, half of it after the frame. Kovar, Gleicher and Pighin take
  /// about a third of a second. Longer ones compare what leads to the pose and what follows it; at 0 only the poses
  /// count.
  double window_s = 1.0 / 3;
  /// The length of the wanted clip that must be left to play, seconds; its front half may always be entered. Ours. A
  /// larger one leaves fewer pairs to choose from.
  double least_play_s = 1;
};
const SettingTable<PointCloudOptions>& PointCloudSettings();

/// Plans with the fuzzy gate over all frames, not bridge frames alone, ranked by the point-cloud distance
/// (PointCloudRows); where no pair passes, through an in-between. Paper A's measure with a finer one behind it.
TransitionRecord PlanFuzzyKovar(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

/// Plans by Kovar, Gleicher and Pighin 2002, as one would use it without fuzzy features: the least point-cloud distance
/// of all pairs. Their threshold on it is left away, since a transition that is asked for must come.
TransitionRecord PlanPointCloud(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

struct MotionMatchingOptions {
  double least_play_s = 1;  ///< as PointCloudOptions'
};
const SettingTable<MotionMatchingOptions>& MotionMatchingSettings();

/// Plans by motion matching (Clavet 2016): the least distance of MotionFeatures of all pairs.
TransitionRecord PlanMotionMatching(const MotionLibrary& library, const TransitionRequest& request,
                                    const MatchRules& rules, const MotionMatchingOptions& options = {});

struct FuzzyWindowOptions {
  /// The length of motion before the frame, and as much after it, over which distances are averaged, seconds. Ours:
  /// twice the window of point clouds.
  double reach_s = 1.0 / 3;
  double least_play_s = 1;  ///< as PointCloudOptions'
};
const SettingTable<FuzzyWindowOptions>& FuzzyWindowSettings();

/// The fuzzy similarity between motions that paper A leaves as future work, used for transitions: the fuzzy gate over
/// all frames, ranked by the mean fuzzy distance over `reach_s` before and as much after the pair;
/// where no pair passes, through an in-between.
TransitionRecord PlanFuzzyWindow(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const FuzzyWindowOptions& options = {});

}  // namespace etude
