#pragma once

#include "engine/base/euler.h"
#include "engine/kinematics/limb_lengths.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/support/gaps.h"

namespace etude {

/// Returns the observation of `pose` by perfect cameras and strokes.
inline LimbObservation Observe(const BodyPose& pose) {
  LimbObservation observation{pose, {}};
  for (Role limb : ObservedLimbs()) {
    observation.directions[Index(limb)] = glm::normalize(pose[limb] - pose[*ParentOf(limb)]);
  }
  return observation;
}

/// Adds noise to an observation: ends by `metres` per axis, directions by `degrees` (standard deviations).
inline LimbObservation Disturb(LimbObservation observation, int trial, double metres, double degrees) {
  RandomStream random({.suite_seed = 7, .scenario = "kinematics-test", .trial = trial}, "observation");
  for (glm::dvec3& end : observation.ends.joints) end += metres * random.Normal3();
  for (Role limb : ObservedLimbs()) {
    const glm::dvec3 axis = glm::normalize(random.Normal3());
    glm::dvec3& direction = observation.directions[Index(limb)];
    direction = AxisRotation(axis, Radians(degrees) * random.Normal()) * direction;
  }
  return observation;
}

}  // namespace etude
