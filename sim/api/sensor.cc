#include <etude/sim/sensor.h>
#include <fmt/format.h>

#include <numbers>

#include "engine/api/convert.h"
#include "sim/rig/rig.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude::sim {
namespace {

void CheckRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw engine::BadInput(fmt::format("{} of {}; allowed: {:g} to {:g}", what, value, low, high));
}

SkeletonSensorOptions ErrorsOf(const SensorOptions& options) {
  CheckRange("a strength", options.strength, 0, 10);
  SkeletonSensorOptions errors;
  if (const auto preset = FindSensorPreset(options.sensor)) {
    errors = *preset;
  } else {
    errors = engine::OrThrow(ReadSensorFile(options.sensor, "sensor"));
  }
  errors.strength = options.strength;
  return errors;
}

engine::Seen SeenOf(TrackingState state) {
  switch (state) {
    case TrackingState::kTracked:
      return engine::Seen::kTracked;
    case TrackingState::kInferred:
      return engine::Seen::kInferred;
    case TrackingState::kNotTracked:
      break;
  }
  return engine::Seen::kNotTracked;
}

}  // namespace

std::vector<engine::SensedPose> SenseSkeleton(const engine::Motion& motion, const SensorOptions& options) {
  const SkeletonSensorOptions errors = ErrorsOf(options);
  CheckRange("a distance in m", options.distance_m, 0.5, 10);
  CheckRange("a turn in radians", options.turn, -2 * std::numbers::pi, 2 * std::numbers::pi);
  CheckRange("a height in m", options.height_m, 0.1, 3);
  const BodyMotion truth = engine::ToBodyMotion(motion);
  if (truth.poses.empty()) throw engine::BadInput("a motion without frames");
  etude::Camera eye = SkeletonSensorAt({options.distance_m, options.turn, options.height_m}, errors.view);
  eye.p_WC += MiddleOnFloor(truth.poses);
  const WorldKey dice{.suite_seed = options.seed, .scenario = "library"};
  std::vector<engine::SensedPose> sensed;
  for (const SensedFrame& frame : etude::SenseSkeleton(truth, eye, {}, errors, dice).frames) {
    engine::SensedPose& pose = sensed.emplace_back();
    pose.body_seen = frame.body_seen;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      pose.pose.joints[i] = frame.joints[i].position;
      pose.seen[i] = SeenOf(frame.joints[i].state);
    }
  }
  return sensed;
}

}  // namespace etude::sim
