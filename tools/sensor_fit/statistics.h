#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/skeleton_sensor/options.h"
#include "tools/sensor_fit/alignment.h"
#include "tools/sensor_fit/recording.h"

namespace etude {

/// The statistics of a sensor's errors in a recording. A value that the recording does not determine is absent: errors
/// need a twin, and depth ratios need the sensor's position.
struct SensorStatistics {
  using ByGroup = std::array<std::optional<double>, kJointGroupCount>;

  ByGroup error_mm;                             ///< root mean square distance from the twin
  std::optional<double> shoulders_and_hips_mm;  ///< the same distance, of shoulders and hips together
  std::optional<double> planted_feet_mm;        ///< as above, of ankles and feet slower than 0.1 m/s in the twin
  /// Standard deviation of the errors along the line of sight, divided by that along an axis across it.
  ByGroup depth_ratio;
  std::array<std::optional<double>, kBoneKindCount> correlation;  ///< correlation of the errors at a bone's two ends
  std::optional<double> quiet_white_mm;  ///< white noise per axis, torso at rest (`StatisticsOf`)
  /// Standard deviation of a bone's length divided by the mean length, per cent; mean over the two bones of an arm, or
  /// of a leg.
  std::optional<double> arm_bones_percent, leg_bones_percent;
  /// Standard deviation divided by mean, per cent: of the distance between the shoulders, and of the bones from wrist
  /// to hand.
  std::optional<double> shoulder_width_percent, hand_bones_percent;
  std::optional<double> hand_jump_cm;  ///< 99th percentile of the hands' second differences
};

/// Computes the statistics of one recording; `match` may be null. Errors of a group are pooled over its joints,
/// correlations over both sides of the body. `quiet_white_mm` is the standard deviation of white noise whose second
/// differences have the observed median length; only torso joints that move less than 5 mm in ten frames are used.
/// Smooth motion and slow errors hardly change this value.
SensorStatistics StatisticsOf(const JointRecording& recording, const TwinMatch* match);

/// A summary of many recordings: the mean and the standard deviation of each statistic over the recordings.
struct SensorStatisticsSummary {
  SensorStatistics mean, deviation;
};
SensorStatisticsSummary Summarise(const std::vector<SensorStatistics>& recordings);

/// The comparison of two values of a statistic: by ratio or by difference.
enum class ComparedBy { kRatio, kDifference };

struct StatisticRow {
  std::string name;
  std::string unit;
  ComparedBy held_by;
  std::optional<double> value;
};

/// Returns the rows of a table of statistics, in order.
std::vector<StatisticRow> RowsOf(const SensorStatistics& statistics);

/// The tolerances of a simulation: statistics that are compared by ratio may differ by 30 % from the real statistics,
/// and correlations by 0.15.
constexpr double kSizeTolerance = 0.30, kCorrelationTolerance = 0.15;

/// The number of rows in which both compared columns have a value (`compared`), and the number of these rows within the
/// tolerances.
struct Agreement {
  int within = 0;
  int compared = 0;
};
Agreement AgreementOf(const SensorStatistics& reference, const SensorStatistics& other);

/// Writes a table for people with one line per statistic and one column per recording; "-" marks an absent value. With
/// `compares`, the second column is followed by its ratio or difference to the first column, and by "!" if this ratio
/// or difference is out of tolerance.
std::string StatisticsTable(const std::vector<std::pair<std::string, SensorStatistics>>& columns, bool compares);

}  // namespace etude
