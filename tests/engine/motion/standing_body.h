#pragma once

#include <tuple>
#include <utility>

#include "engine/motion/body.h"

namespace etude {

inline BodyPose Standing() {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, 0.9, 0};
  pose[kSpine] = {0, 1.1, 0};
  pose[kShoulderCentre] = {0, 1.4, 0};
  pose[kHead] = {0, 1.6, 0};
  for (const auto& [hip, knee, ankle, foot, x] : {std::tuple{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot, 0.1},
                                                  std::tuple{kRightHip, kRightKnee, kRightAnkle, kRightFoot, -0.1}}) {
    pose[hip] = {x, 0.9, 0};
    pose[knee] = {x, 0.5, 0};
    pose[ankle] = {x, 0.1, 0};
    pose[foot] = {x, 0, 0.15};
  }
  for (const auto& [role, x] : {std::pair{kLeftShoulder, 0.2}, std::pair{kLeftElbow, 0.5}, std::pair{kLeftWrist, 0.7},
                                std::pair{kLeftHand, 0.8}}) {
    pose[role] = {x, 1.4, 0};
    pose[Mirrored(role)] = {-x, 1.4, 0};
  }
  return pose;
}

}  // namespace etude
