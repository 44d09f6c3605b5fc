#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/motion/body.h"

namespace etude {

/// The sensor's own word about a joint: Kinect's own contract (SDK 1.x, NUI_SKELETON_POSITION_TRACKING_STATE).
enum class TrackingState {
  kTracked,     ///< seen
  kInferred,    ///< not seen, guessed from its neighbours: may be far off
  kNotTracked,  ///< no data; the position repeats the last one reported
};

struct SensedJoint {
  glm::dvec3 position{0};  ///< metres, in the world (Y up, floor at 0): the sensor knows where it stands
  TrackingState state = TrackingState::kNotTracked;
};

struct SensedFrame {
  std::array<SensedJoint, kRoleCount> joints{};
  bool body_seen = false;  ///< false: the sensor lost the whole body, every joint is kNotTracked

  SensedJoint& operator[](Role role) { return joints[Index(role)]; }
  const SensedJoint& operator[](Role role) const { return joints[Index(role)]; }
};

/// A skeleton sensor's output, which recognition works on.
struct SkeletonStream {
  double rate_hz = kJudgedRateHz;
  std::vector<SensedFrame> frames;
};

/// The positions alone.
BodyPose PoseOf(const SensedFrame& frame);
BodyMotion MotionOf(const SkeletonStream& stream);

/// Returns the stream of a sensor without errors: every joint tracked, where it is.
SkeletonStream StreamOf(const BodyMotion& motion);

/// One frame as a recogniser sees it: paper A's ten features, and how well each was seen.
struct FeatureFrame {
  PoseFeatures features;
  std::array<TrackingState, kFeatureCount> states{};  ///< the worst state among the feature's joints
  bool body_seen = false;                             ///< false: nothing of the rest means anything

  TrackingState StateOf(Feature feature) const { return states[static_cast<std::size_t>(feature)]; }
};

/// Computes the features of a frame. `standing_hip_height` is in metres, > 0.
FeatureFrame SeeFeatures(const SensedFrame& frame, double standing_hip_height);

}  // namespace etude
