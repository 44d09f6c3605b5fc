#pragma once

#include "engine/base/settings.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

// The choices in this header rank all pairs of frames that the budget and `least_play_s` allow (AllowedAnyFrames). The
// fuzzy choices rank only the matching pairs among these.

struct PointCloudOptions {
  /// The length of motion in a point cloud, in seconds, centred on the frame. The default, about a third of a second,
  /// comes from Kovar, Gleicher and Pighin. A longer window also compares the motion before and after the pose; with 0,
  /// only the poses are compared.
  double window_s = 1.0 / 3;
  /// The minimum time that the wanted clip must still play after it is entered, in seconds (the default is ours).
  /// Entering the clip's front half is always allowed. A larger value leaves fewer pairs to choose from.
  double least_play_s = 1;
};
const SettingTable<PointCloudOptions>& PointCloudSettings();

/// Takes the matching pair of frames (FuzzyGate) with the smallest point-cloud distance (PointCloudRows). This distance
/// refines paper A's measure. Frames need not be bridge frames. If no pair matches, the plan goes through an
/// in-between.
TransitionRecord PlanFuzzyKovar(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

/// Takes the pair with the smallest point-cloud distance (Kovar, Gleicher and Pighin 2002), without fuzzy features. The
/// paper's threshold is omitted, because a requested transition must take place.
TransitionRecord PlanPointCloud(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options = {});

struct MotionMatchingOptions {
  double least_play_s = 1;  ///< as `PointCloudOptions::least_play_s`, seconds
};
const SettingTable<MotionMatchingOptions>& MotionMatchingSettings();

/// Plans by motion matching (Clavet 2016): takes the pair with the smallest distance of MotionFeatures.
TransitionRecord PlanMotionMatching(const MotionLibrary& library, const TransitionRequest& request,
                                    const MatchRules& rules, const MotionMatchingOptions& options = {});

struct FuzzyWindowOptions {
  /// Distances are averaged over this time before the frame and over the same time after it, in seconds. The default
  /// (ours) makes the window twice as long as that of point clouds.
  double reach_s = 1.0 / 3;
  double least_play_s = 1;  ///< as `PointCloudOptions::least_play_s`, seconds
};
const SettingTable<FuzzyWindowOptions>& FuzzyWindowSettings();

/// Plans by a fuzzy similarity between motions, which paper A leaves as future work. Takes the matching pair of frames
/// (FuzzyGate) with the smallest mean fuzzy distance over the frames up to `reach_s` before and after the pair. Frames
/// need not be bridge frames. If no pair matches, the plan goes through an in-between.
TransitionRecord PlanFuzzyWindow(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const FuzzyWindowOptions& options = {});

}  // namespace etude
