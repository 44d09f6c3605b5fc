#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bench/sensor_fit/alignment.h"
#include "bench/sensor_fit/recording.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// What a recording says of its sensor's errors. A value is absent where the recording cannot tell it: all that begins
/// with an error needs a twin, ratios need to know where the sensor stands.
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

/// The statistics of one recording; `match` may be null. Errors of a group are pooled over its joints, correlations
/// over both sides of the body. The quiet part is the middle length of the torso joints' second differences over three
/// frames, where the joint moves less than 5 mm in ten frames, as the deviation of white noise that would show it:
/// smooth motion and slow errors hardly enter.
SensorStatistics StatisticsOf(const JointRecording& recording, const TwinMatch* match);

/// Of many recordings: each statistic's mean, and its deviation from one recording to the next.
struct SensorStatisticsSummary {
  SensorStatistics mean, deviation;
};
SensorStatisticsSummary Summarise(const std::vector<SensorStatistics>& recordings);

}  // namespace etude
