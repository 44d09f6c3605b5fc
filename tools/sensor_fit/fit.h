#pragma once

#include <functional>
#include <optional>

#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"
#include "tools/sensor_fit/alignment.h"
#include "tools/sensor_fit/statistics.h"

namespace etude {

/// A real recording, its twin, and their alignment: simulated recordings are made from them and compared with them.
struct RealRecording {
  JointRecording recording;
  TwinMotion twin;
  TwinMatch match;
};

/// Aligns the two. Returns nothing when they do not go together (see `AlignTwin`).
std::optional<RealRecording> MakeRealRecording(JointRecording recording, TwinMotion twin);

SensorStatistics StatisticsOf(const RealRecording& real);

/// Simulates the sensor's report of the twin's motion, from the real sensor's place (2.75 m before the body and 1 m
/// high where it is not known). Joints are absent where the twin's are.
JointRecording Simulate(const RealRecording& real, const SkeletonSensorOptions& options, const WorldKey& world);

/// Summarises the statistics of so many simulated recordings, each aligned to the twin as a real one.
SensorStatisticsSummary SimulatedStatistics(const RealRecording& real, const SkeletonSensorOptions& options, int worlds,
                                            const WorldKey& first_world);

struct SensorFitOptions {
  SkeletonSensorOptions start = SensorV2();  ///< what is not fitted stays as here
  int worlds = 96;                           ///< simulated recordings per step; more: less noise in what is fitted
  int steps = 10;
  std::function<void(int step)> progress;
};

/// Fits the sensor whose simulated recordings of the twin's motion have the real one's statistics, by moments:
/// simulate, compare, correct, again. Fitted: each group's size and depth ratio, planted feet, correlations along
/// bones, the quiet part, the fast part's share, how much shoulders, arms and hands stretch (by the hands' jumps), the
/// reference distance. Everything else cannot be told from a recording like these, and is kept. What the recording does
/// not show (a group that was never seen) is kept, too. Deterministic.
SkeletonSensorOptions FitSensor(const RealRecording& real, const SensorFitOptions& options);

}  // namespace etude
