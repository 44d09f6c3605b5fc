#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// Reads a sensor file (docs/sensor.md): YAML, all keys optional on top of the preset that `based_on` names.
///
///     based_on: v2                # or v1
///     reference_distance_m: 2.9
///     planted_feet_m: 0.003
///     fast_share: 0.2
///     groups:
///       torso: {size_m: 0.021, depth_ratio: 1.2, still_m: 0.001, white_m: 0.0001}
///     correlation: {upper_arm: 0.04, shank: 0.49}
///
/// Refuses unknown keys and values out of range, with file, line and column.
Result<SkeletonSensorOptions> ReadSensorFile(std::string_view text, const std::string& file);

/// Writes all keys of such a file but `strength`, which is a scenario's. What was read from it is written the same.
std::string WriteSensorFile(const SkeletonSensorOptions& options, std::string_view based_on);

}  // namespace etude
