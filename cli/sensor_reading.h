#pragma once

#include <string>

#include "bench/sensor_fit/fit.h"
#include "cli/sensor_commands.h"

namespace etude {

/// A Kinect v2's text or joint CSV.
Result<JointRecording> LoadJointRecording(const std::string& path, const SensorReading& reading);

/// A recording aligned to its reference. Fails when the two do not go together.
Result<RealRecording> LoadRealRecording(const std::string& path, const SensorReading& reading);

/// "v1", "v2" or a sensor file.
Result<SkeletonSensorOptions> LoadSensor(const std::string& reference);

/// "197 frames at 30 Hz, 6.6 s; 0.0 % of the joints missing"
std::string DescribeRecording(const JointRecording& recording);
/// "390 frames at 60 Hz, 6.5 s; …": the reference, and how the two lie to each other.
std::string DescribeMatch(const RealRecording& real);

}  // namespace etude
