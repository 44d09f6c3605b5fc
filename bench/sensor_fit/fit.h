#pragma once

#include <functional>

#include "bench/sensor_fit/simulated.h"

namespace etude {

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
