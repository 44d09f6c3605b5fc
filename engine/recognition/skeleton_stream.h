#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

/// The sensor's confidence in a joint, as Kinect defines it (SDK 1.x, NUI_SKELETON_POSITION_TRACKING_STATE).
enum class TrackingState {
  kTracked,     ///< measured
  kInferred,    ///< not visible; estimated from its neighbours and possibly far off
  kNotTracked,  ///< no data; the position repeats the last reported one
};

struct SensedJoint {
  glm::dvec3 position{0};  ///< position in the world (Y up, floor at 0), metres; the sensor's pose is known
  TrackingState state = TrackingState::kNotTracked;
};

struct SensedFrame {
  std::array<SensedJoint, kRoleCount> joints{};
  bool body_seen = false;  ///< false if the sensor lost the whole body; then every joint is kNotTracked

  SensedJoint& operator[](Role role) { return joints[Index(role)]; }
  const SensedJoint& operator[](Role role) const { return joints[Index(role)]; }
};

/// The output of a skeleton sensor, which is the input of recognition.
struct SkeletonStream {
  double rate_hz = kJudgedRateHz;
  std::vector<SensedFrame> frames;
};

/// Returns the joint positions without their states.
BodyPose PoseOf(const SensedFrame& frame);
/// Returns the joint positions of all frames, including joints that are not tracked.
BodyMotion MotionOf(const SkeletonStream& stream);

/// Returns the stream of a sensor without errors: every joint is tracked at its true position.
SkeletonStream StreamOf(const BodyMotion& motion);

/// Paper A's ten features of one frame, each with the tracking state of its joints.
struct FeatureFrame {
  PoseFeatures features;
  std::array<TrackingState, kFeatureCount> states{};  ///< the worst state among the feature's joints
  bool body_seen = false;                             ///< if false, the other fields are meaningless

  /// Returns the worst tracking state among the joints of a feature.
  TrackingState StateOf(Feature feature) const { return states[static_cast<std::size_t>(feature)]; }
};

/// Computes the features of a frame. `standing_hip_height` is in metres and > 0.
FeatureFrame SeeFeatures(const SensedFrame& frame, double standing_hip_height);

}  // namespace etude
