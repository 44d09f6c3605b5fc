#pragma once

#include "engine/base/settings.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

// The choices that rank all pairs of frames allowed by the budget and by `least_play_s` (AllowedAnyFrames).

struct PointCloudOptions {
  /// The length of motion in a point cloud, in seconds, centred on the frame. The default is that of Kovar, Gleicher
  /// and Pighin, about a third of a second. A longer window also compares the motion before and after the pose; at 0
  /// only the poses count.
  double window_s = 1.0 / 3;
  /// The length of the wanted clip that must be left to play, in seconds (default ours). Entering the clip's front half
  /// is always allowed. A larger value leaves fewer pairs to choose from.
  double least_play_s = 1;
};
const SettingTable<PointCloudOptions>& PointCloudSettings();

/// Plans with the fuzzy gate over all frames, not only bridge frames, and ranks the passing pairs by the point-cloud
/// distance (PointCloudRows). This refines paper A's measure. If no pair passes, the plan goes through an in-between.
TransitionRecord PlanFuzzyKovar(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

/// Plans by the smallest point-cloud distance of all pairs (Kovar, Gleicher and Pighin 2002), without fuzzy features.
/// Their threshold is omitted, because a requested transition must take place.
TransitionRecord PlanPointCloud(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

struct MotionMatchingOptions {
  double least_play_s = 1;  ///< as in PointCloudOptions
};
const SettingTable<MotionMatchingOptions>& MotionMatchingSettings();

/// Plans by motion matching (Clavet 2016): takes the pair with the smallest distance of MotionFeatures.
TransitionRecord PlanMotionMatching(const MotionLibrary& library, const TransitionRequest& request,
                                    const MatchRules& rules, const MotionMatchingOptions& options = {});

struct FuzzyWindowOptions {
  /// The time before and after the frame over which distances are averaged, in seconds each. The default (ours) makes
  /// the window twice that of point clouds.
  double reach_s = 1.0 / 3;
  double least_play_s = 1;  ///< as in PointCloudOptions
};
const SettingTable<FuzzyWindowOptions>& FuzzyWindowSettings();

/// Plans by a fuzzy similarity between motions, which paper A leaves as future work: the fuzzy gate selects among all
/// frames, and the mean fuzzy distance over `reach_s` before and after ranks the passing pairs. If no pair passes, the
/// plan goes through an in-between.
TransitionRecord PlanFuzzyWindow(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const FuzzyWindowOptions& options = {});

}  // namespace etude
