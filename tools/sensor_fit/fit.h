#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"
#include "tools/sensor_fit/alignment.h"
#include "tools/sensor_fit/statistics.h"

namespace etude {

/// A real recording, its twin (the optical recording of the same motion), and their alignment. Simulations start from
/// the twin's motion and are compared with the recording.
struct RealRecording {
  JointRecording recording;
  TwinMotion twin;
  TwinMatch match;
};

/// Aligns a recording with its twin. Returns nullopt if AlignTwin fails.
std::optional<RealRecording> MakeRealRecording(JointRecording recording, TwinMotion twin);

/// Describes why a recording and its twin cannot show the same motion: one body is more than twice as large as the
/// other, the mirrored recording fits much better, or more than 0.3 m RMS remain. Returns "" if they can.
std::string DescribeMismatch(const RealRecording& real);

SensorStatistics StatisticsOf(const RealRecording& real);

/// Simulates the sensor's recording of the twin's motion, seen from the real sensor's position. If that position is
/// unknown, the simulated sensor stands at the usual distance in front of the body (`SensorPlacement`). A joint that
/// the twin lacks is absent.
JointRecording Simulate(const RealRecording& real, const SkeletonSensorOptions& options, const WorldKey& world);

/// Returns statistics over `worlds` simulated recordings; each simulated recording is aligned with the twin in the same
/// way as the real recording.
SensorStatisticsSummary SimulatedStatistics(const RealRecording& real, const SkeletonSensorOptions& options, int worlds,
                                            const WorldKey& first_world);

struct SensorFitOptions {
  SkeletonSensorOptions start = SensorV2();  ///< settings that are not fitted keep these values
  /// The number of simulated recordings in each step of the fit. More recordings reduce the noise of the fitted values.
  int worlds = 96;
  int steps = 10;
  std::function<void(int step)> progress;
};

struct FittedSensor {
  SkeletonSensorOptions sensor;
  /// The settings that the last step would have moved beyond the range that the fit allows, each with its value, such
  /// as "groups.hands.size_m 0.5": the fitted sensor does not reproduce the recording in these.
  std::vector<std::string> at_bounds;
};

/// Fits a sensor by the method of moments, so that its simulated recordings of the twin's motion have the statistics of
/// the real recording. Each step simulates, compares and corrects. The fitted settings are: each group's size and depth
/// ratio, planted feet, correlations along bones, the white noise and the fast noise at rest, the share of fast errors
/// (from the jumps of the hands), the stretch of shoulders, arms and hands, and the reference distance. All other
/// settings keep their values, because one recording does not determine them. The settings of groups that were never
/// seen also keep their values. The result is deterministic.
FittedSensor FitSensor(const RealRecording& real, const SensorFitOptions& options);

}  // namespace etude
