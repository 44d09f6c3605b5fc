#pragma once

#include <string_view>

namespace etude {

/// The key of a task that senses skeletons: a preset, a sensor file (docs/sensor.md), or cameras. Whoever makes the
/// task opens what it names, and gives the text in TaskInput::texts.
constexpr const char* kSensorKey = "sensor";
constexpr const char* kCameraSensor = "cameras";

/// Whether a reference names a file, and no preset and not the cameras.
constexpr bool IsSensorFile(std::string_view reference) {
  return reference != "v1" && reference != "v2" && reference != kCameraSensor;
}

}  // namespace etude
