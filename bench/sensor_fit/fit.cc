#include "bench/sensor_fit/fit.h"

#include <algorithm>
#include <cmath>

#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr WorldKey kFitWorlds{.suite_seed = 1, .scenario = "sensor-fit", .trial = 0};

/// Moves `value` by real ÷ simulated, at most threefold at once, and keeps it within what a sensor file may say.
void Scale(double& value, const std::optional<double>& real, const std::optional<double>& simulated, Range allowed) {
  if (!real || !simulated || *real <= 0 || *simulated <= 0) return;
  constexpr double kMost = 3;
  value = std::clamp(value * std::clamp(*real / *simulated, 1 / kMost, kMost), allowed.lowest, allowed.highest);
}

void FitGroups(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  for (const JointGroup group : AllJointGroups()) {
    const std::size_t g = Index(group);
    if (group != JointGroup::kFeet) Scale(sensor[group].size, real.error_mm[g], simulated.error_mm[g], {0.001, 0.5});
    Scale(sensor[group].depth_ratio, real.depth_ratio[g], simulated.depth_ratio[g], {0.2, 5});
  }
  Scale(sensor.planted_feet, real.planted_feet_mm, simulated.planted_feet_mm, {0.0001, 0.1});
}

void FitCorrelations(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  constexpr double kStep = 0.8, kMost = 0.98;
  for (std::size_t b = 0; b < kBoneKindCount; ++b) {
    if (!real.correlation[b] || !simulated.correlation[b]) continue;
    double& rho = sensor.correlation[b];
    rho = std::clamp(rho + kStep * (*real.correlation[b] - *simulated.correlation[b]), -kMost, kMost);
  }
}

void FitQuiet(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  if (!real.quiet_white_mm || !simulated.quiet_white_mm || *simulated.quiet_white_mm <= 0) return;
  for (GroupErrors& group : sensor.groups) {
    Scale(group.white, real.quiet_white_mm, simulated.quiet_white_mm, {0, 0.05});
  }
  Scale(sensor.fast_quiet, real.quiet_white_mm, simulated.quiet_white_mm, {0, 1});
}

void FitFastPart(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  Scale(sensor.fast_share, real.hand_jump_cm, simulated.hand_jump_cm, {0.01, 0.8});
}

void FitStretch(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  Scale(sensor.arm_stretch, real.arm_bones_percent, simulated.arm_bones_percent, {0.02, 4});
  Scale(sensor.shoulder_stretch, real.shoulder_width_percent, simulated.shoulder_width_percent, {0.02, 4});
  Scale(sensor.hand_stretch, real.hand_bones_percent, simulated.hand_bones_percent, {0.02, 4});
}

double MeanDistance(const RealRecording& real) {
  double sum = 0, count = 0;
  for (const RolePlaces& places : real.match.truth) {
    const auto& centre = places[Index(Role::kSpine)];
    if (!centre || !real.recording.sensor_at) continue;
    sum += std::abs(centre->z - real.recording.sensor_at->z);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

SkeletonSensorOptions FitSensor(const RealRecording& real, const SensorFitOptions& options) {
  const SensorStatistics measured = StatisticsOf(real);
  SkeletonSensorOptions sensor = options.start;
  if (const double distance = MeanDistance(real); distance > 0) sensor.reference_distance_m = distance;
  for (int step = 0; step < options.steps; ++step) {
    const SensorStatistics simulated = SimulatedStatistics(real, sensor, options.worlds, kFitWorlds).mean;
    FitGroups(measured, simulated, sensor);
    FitCorrelations(measured, simulated, sensor);
    FitQuiet(measured, simulated, sensor);
    FitFastPart(measured, simulated, sensor);
    FitStretch(measured, simulated, sensor);
    if (options.progress) options.progress(step);
  }
  return sensor;
}

}  // namespace etude
