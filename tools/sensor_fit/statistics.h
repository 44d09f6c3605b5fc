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

/// The statistics of a sensor's errors in a recording. A value is absent where the recording cannot tell it: all that
/// begins with an error needs a twin, ratios need to know where the sensor stands.
struct SensorStatistics {
  using ByGroup = std::array<std::optional<double>, kJointGroupCount>;

  ByGroup error_mm;                             ///< root mean square distance from the twin
  std::optional<double> shoulders_and_hips_mm;  ///< both groups together
  std::optional<double> planted_feet_mm;        ///< ankles and feet whose twin is slower than 0.1 m/s
  ByGroup depth_ratio;                          ///< deviation along the line of sight ÷ along an axis across it
  std::array<std::optional<double>, kBoneKindCount> correlation;  ///< of the errors at both ends of a bone
  std::optional<double> quiet_white_mm;                        ///< per axis, of the torso at rest: see `StatisticsOf`
  std::optional<double> arm_bones_percent, leg_bones_percent;  ///< deviation of lengths ÷ mean, both bones
  std::optional<double> shoulder_width_percent, hand_bones_percent;  ///< likewise; hand: wrist to hand
  std::optional<double> hand_jump_cm;  ///< 99th percentile of the hands' second differences
};

/// Computes the statistics of one recording; `match` may be null. Errors of a group are pooled over its joints,
/// correlations over both sides of the body. The quiet part is the middle length of the torso joints' second
/// differences over three frames, where the joint moves less than 5 mm in ten frames, as the deviation of white noise
/// that would show it: smooth motion and slow errors hardly enter.
SensorStatistics StatisticsOf(const JointRecording& recording, const TwinMatch* match);

/// A summary of many recordings: each statistic's mean, and its deviation from one recording to the next.
struct SensorStatisticsSummary {
  SensorStatistics mean, deviation;
};
SensorStatisticsSummary Summarise(const std::vector<SensorStatistics>& recordings);

/// The way in which two values of a statistic are compared.
enum class HeldBy { kRatio, kDifference };

struct StatisticRow {
  std::string name;
  std::string unit;
  HeldBy held_by;
  std::optional<double> value;
};

/// Returns the rows of a table of statistics, in order.
std::vector<StatisticRow> RowsOf(const SensorStatistics& statistics);

/// The tolerances of a simulation: sizes within 30 % of real ones, correlations within 0.15.
constexpr double kSizeTolerance = 0.30, kCorrelationTolerance = 0.15;

/// The number of rows that both columns have, and of those among them that lie within the tolerances.
struct Agreement {
  int within = 0;
  int compared = 0;
};
Agreement AgreementOf(const SensorStatistics& reference, const SensorStatistics& other);

/// Writes a table for people, a line per statistic and a column per recording, "-" for what one cannot tell. With
/// `compares`, the second column is held against the first: its ratio or difference, "!" where out of tolerance.
std::string StatisticsTable(const std::vector<std::pair<std::string, SensorStatistics>>& columns, bool compares);

}  // namespace etude
