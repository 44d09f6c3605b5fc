#pragma once

namespace etude {

/// The key of a condition that names the sensor of skeletons. Its value is a preset, a sensor file (docs/sensor.md), or
/// cameras.
constexpr const char* kSensorKey = "sensor";
constexpr const char* kCameraSensor = "cameras";

}  // namespace etude
