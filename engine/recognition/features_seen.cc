#include "engine/recognition/features_seen.h"

#include <algorithm>

namespace etude {
namespace {

/// Tracked < inferred < not tracked, as the enum is ordered.
TrackingState WorstOf(const SensedFrame& frame, std::span<const Role> joints) {
  TrackingState worst = TrackingState::kTracked;
  for (Role role : joints) worst = std::max(worst, frame[role].state);
  return worst;
}

}  // namespace

FeatureFrame SeeFeatures(const SensedFrame& frame, double standing_hip_height) {
  FeatureFrame seen;
  seen.body_seen = frame.body_seen;
  seen.features = ComputeFeatures(PoseOf(frame), standing_hip_height);
  for (Feature feature : AllFeatures()) {
    seen.states[static_cast<std::size_t>(feature)] = WorstOf(frame, JointsOf(feature));
  }
  return seen;
}

}  // namespace etude
