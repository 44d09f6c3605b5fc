#include <etude/sim/sensor.h>
#include <fmt/format.h>

#include <numbers>

#include "engine/api/checks.h"
#include "sim/rig/rig.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude::sim {
namespace {

void CheckRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw engine::BadInput(fmt::format("{} {}; allowed: {:g} to {:g}", what, value, low, high));
}

SkeletonSensorOptions ErrorsOf(const SensorOptions& options) {
  CheckRange("strength", options.strength, 0, 10);
  SkeletonSensorOptions errors;
  if (const auto preset = FindSensorPreset(options.sensor)) {
    errors = *preset;
  } else {
    errors = engine::OrThrow(ReadSensorFile(options.sensor, "sensor"));
  }
  errors.strength = options.strength;
  return errors;
}

}  // namespace

SkeletonStream SenseSkeleton(const BodyMotion& motion, const SensorOptions& options) {
  const SkeletonSensorOptions errors = ErrorsOf(options);
  CheckRange("distance_m", options.distance_m, 0.5, 10);
  CheckRange("turn (radians)", options.turn, -2 * std::numbers::pi, 2 * std::numbers::pi);
  CheckRange("height_m", options.height_m, 0.1, 3);
  if (engine::Checked(motion).poses.empty()) throw engine::BadInput("a motion without frames");
  Camera eye = SkeletonSensorAt({options.distance_m, options.turn, options.height_m}, errors.view);
  eye.p_WC += MiddleOnFloor(motion.poses);
  return etude::SenseSkeleton(motion, eye, {}, errors, {.suite_seed = options.seed, .scenario = "library"});
}

}  // namespace etude::sim
