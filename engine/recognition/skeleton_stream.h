#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// What the sensor says about a joint: Kinect's own contract (SDK 1.x, NUI_SKELETON_POSITION_TRACKING_STATE).
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

/// What a skeleton sensor delivers, and what recognition works on.
struct SkeletonStream {
  double rate_hz = kJudgedRateHz;
  std::vector<SensedFrame> frames;
};

/// The positions alone.
BodyPose PoseOf(const SensedFrame& frame);
BodyMotion MotionOf(const SkeletonStream& stream);

/// What a sensor without errors would deliver: every joint tracked, where it is.
SkeletonStream StreamOf(const BodyMotion& motion);

}  // namespace etude
