#include "engine/recognition/skeleton_stream.h"

#include <algorithm>

namespace etude {

BodyPose PoseOf(const SensedFrame& frame) {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = frame.joints[i].position;
  return pose;
}

BodyMotion MotionOf(const SkeletonStream& stream) {
  BodyMotion motion{.rate_hz = stream.rate_hz, .poses = {}};
  motion.poses.reserve(stream.frames.size());
  for (const SensedFrame& frame : stream.frames) motion.poses.push_back(PoseOf(frame));
  return motion;
}

SkeletonStream StreamOf(const BodyMotion& motion) {
  SkeletonStream stream{.rate_hz = motion.rate_hz, .frames = {}};
  for (const BodyPose& pose : motion.poses) {
    SensedFrame& frame = stream.frames.emplace_back();
    frame.body_seen = true;
    for (std::size_t i = 0; i < kRoleCount; ++i) frame.joints[i] = {pose.joints[i], TrackingState::kTracked};
  }
  return stream;
}

namespace {

/// Returns the worst state among the joints; the enum is ordered tracked < inferred < not tracked.
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
