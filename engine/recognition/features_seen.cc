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

std::vector<FeatureFrame> SeeFeatures(const SkeletonStream& stream, double standing_hip_height) {
  std::vector<FeatureFrame> seen;
  seen.reserve(stream.frames.size());
  for (const SensedFrame& frame : stream.frames) {
    FeatureFrame& out = seen.emplace_back();
    out.body_seen = frame.body_seen;
    out.features = ComputeFeatures(PoseOf(frame), standing_hip_height);
    for (Feature feature : AllFeatures()) {
      out.states[static_cast<std::size_t>(feature)] = WorstOf(frame, JointsOf(feature));
    }
  }
  return seen;
}

double EstimateStandingHipHeight(const SkeletonStream& stream) {
  constexpr double kFallback = 0.9;  // the height to which motions are scaled for judging
  const auto wanted = static_cast<std::size_t>(stream.rate_hz);
  std::vector<double> heights;
  for (const SensedFrame& frame : stream.frames) {
    if (heights.size() >= wanted) break;
    if (frame.body_seen) heights.push_back(StandingHipHeight(PoseOf(frame)));
  }
  if (heights.empty()) return kFallback;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle > 0 ? *middle : kFallback;
}

}  // namespace etude
