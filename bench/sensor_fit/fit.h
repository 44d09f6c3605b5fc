#pragma once

#include <functional>
#include <optional>

#include "bench/sensor_fit/alignment.h"
#include "bench/sensor_fit/statistics.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// A real recording, its twin, and how they lie to each other: what simulated recordings are made of and held against.
struct RealRecording {
  JointRecording recording;
  TwinMotion twin;
  TwinMatch match;
};

/// Aligns the two. Nothing when they do not go together (see `AlignTwin`).
std::optional<RealRecording> MakeRealRecording(JointRecording recording, TwinMotion twin);

SensorStatistics StatisticsOf(const RealRecording& real);

/// What the simulated sensor says of the twin's motion, from the real sensor's place (2.75 m before the body and 1 m
/// high where nobody knows it). Absent where the twin is.
JointRecording Simulate(const RealRecording& real, const SkeletonSensorOptions& options, const WorldKey& world);

/// The statistics of so many simulated recordings, each aligned to the twin as a real one.
SensorStatisticsSummary SimulatedStatistics(const RealRecording& real, const SkeletonSensorOptions& options, int worlds,
                                            const WorldKey& first_world);

struct SensorFitOptions {
  SkeletonSensorOptions start = SensorV2();  ///< what is not fitted stays as here
  int worlds = 96;                           ///< simulated recordings per step; more: less noise in what is fitted
  int steps = 10;
  std::function<void(int step)> progress;
};

/// The sensor whose simulated recordings of the twin's motion have the real one's statistics, by moments: simulate,
/// compare, correct, again. Fitted: each group's size and depth ratio, planted feet, correlations along bones, the
/// quiet part, the fast part's share, how much shoulders, arms and hands stretch (by the hands' jumps), the reference
/// distance. Everything else cannot be told from a recording like these, and is kept. What the recording does not show
/// (a group that was never seen) is kept, too. Deterministic.
SkeletonSensorOptions FitSensor(const RealRecording& real, const SensorFitOptions& options);

}  // namespace etude
