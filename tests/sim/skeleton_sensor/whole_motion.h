#pragma once

#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/skeleton_sensor/joint_errors.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

using JointErrors = std::vector<FrameErrors>;

/// Runs the sensor's processes over a whole motion; returns one entry per frame.
inline JointErrors ErrorsOver(const BodyMotion& truth, const Camera& sensor, const SkeletonSensorOptions& options,
                              const WorldKey& world) {
  ContinuousErrors process(sensor, options, truth.rate_hz, world);
  MotionWindow window(truth.rate_hz);
  JointErrors errors;
  for (const BodyPose& pose : truth.poses) {
    window.Push(pose);
    if (const auto known = window.Next()) errors.push_back(process.Next(known->pose, known->motion));
  }
  window.End();
  while (const auto known = window.Next()) errors.push_back(process.Next(known->pose, known->motion));
  return errors;
}

inline std::vector<FrameGuesses> GuessesOver(const BodyMotion& truth, const std::vector<HiddenJoints>& hidden,
                                             const SkeletonSensorOptions& options, const WorldKey& world) {
  OcclusionGuesses process(options, world);
  std::vector<FrameGuesses> guesses;
  for (std::size_t t = 0; t < hidden.size(); ++t) guesses.push_back(process.Next(truth.poses[t], hidden[t]));
  return guesses;
}

inline std::vector<HiddenJoints> HiddenOver(const BodyMotion& truth, const Occluders& occluders,
                                            const glm::dvec3& eye) {
  std::vector<HiddenJoints> hidden;
  for (std::size_t t = 0; t < truth.poses.size(); ++t) {
    hidden.push_back(FindHidden(truth.poses[t], t, occluders, eye));
  }
  return hidden;
}

}  // namespace etude
