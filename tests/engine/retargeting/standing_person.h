#pragma once

#include "engine/motion/body.h"

namespace etude::testing {

/// Returns a person who stands with hanging arms and faces +Z: hips 0.18 m apart, thighs and shanks of 0.42 m; metres, Y
/// up.
inline BodyPose StandingPerson() {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, 0.9, 0};
  pose[kSpine] = {0, 1.15, 0};
  pose[kShoulderCentre] = {0, 1.4, 0};
  pose[kHead] = {0, 1.6, 0};
  const auto put = [&](Role left, double x, double y, double z) {
    pose[left] = {x, y, z};
    pose[Mirrored(left)] = {-x, y, z};
  };
  put(kLeftShoulder, 0.18, 1.4, 0);
  put(kLeftElbow, 0.2, 1.1, 0);
  put(kLeftWrist, 0.2, 0.85, 0);
  put(kLeftHand, 0.2, 0.7, 0);
  put(kLeftHip, 0.09, 0.9, 0);
  put(kLeftKnee, 0.09, 0.48, 0);
  put(kLeftAnkle, 0.09, 0.06, 0);
  put(kLeftFoot, 0.09, 0.02, 0.17);
  return pose;
}

}  // namespace etude::testing
