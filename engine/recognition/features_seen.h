#pragma once

#include <array>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// One frame as a recogniser sees it: paper A's ten features, and how well each was seen.
struct FeatureFrame {
  PoseFeatures features;
  std::array<TrackingState, kFeatureCount> states{};  ///< the worst state among the feature's joints
  bool body_seen = false;                             ///< false: nothing of the rest means anything
};

/// The ten features of every frame. `standing_hip_height` in metres, > 0.
std::vector<FeatureFrame> SeeFeatures(const SkeletonStream& stream, double standing_hip_height);

/// The hip height this performer has when standing: the median, over the first second in which the body
/// was seen, of what the limb lengths say (single frames vary by 4–12 %). 0.9 m for a stream without a body.
double EstimateStandingHipHeight(const SkeletonStream& stream);

}  // namespace etude
