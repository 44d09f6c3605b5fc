#pragma once

#include <array>

#include "engine/fuzzy/features.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// One frame as a recogniser sees it: paper A's ten features, and how well each was seen.
struct FeatureFrame {
  PoseFeatures features;
  std::array<TrackingState, kFeatureCount> states{};  ///< the worst state among the feature's joints
  bool body_seen = false;                             ///< false: nothing of the rest means anything

  TrackingState StateOf(Feature feature) const { return states[static_cast<std::size_t>(feature)]; }
};

/// `standing_hip_height` in metres, > 0.
FeatureFrame SeeFeatures(const SensedFrame& frame, double standing_hip_height);

}  // namespace etude
