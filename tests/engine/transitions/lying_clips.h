#pragma once

#include <glm/gtc/quaternion.hpp>

#include "engine/base/smoothstep.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {

/// Returns a straight body tipped backwards about its feet: at 0° it stands, at 90° it lies on its back.
inline BodyPose TippedBody(double degrees) {
  BodyPose pose = PosedBody().Pose();
  const glm::dvec3 pivot = 0.5 * (pose[Role::kLeftFoot] + pose[Role::kRightFoot]);
  const glm::dquat turn = glm::angleAxis(Radians(-degrees), glm::dvec3(1, 0, 0));
  for (glm::dvec3& joint : pose.joints) joint = pivot + turn * (joint - pivot);
  return pose;
}

inline BodyMotion LyingClip(int frames) {
  return {kJudgedRateHz, std::vector<BodyPose>(static_cast<std::size_t>(frames), TippedBody(90))};
}

/// Returns a clip whose body lies for a quarter of the time, rises, and stands for the last quarter.
inline BodyMotion RisingClip(int frames) {
  BodyMotion motion;
  for (int f = 0; f < frames; ++f) {
    motion.poses.push_back(TippedBody(90 * (1 - Smootherstep(2.0 * f / frames - 0.5))));
  }
  return motion;
}

}  // namespace etude
