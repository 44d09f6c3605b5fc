#pragma once

#include <string_view>

namespace etude {

/// The key of a task that senses skeletons: a preset or a sensor file (docs/sensor.md). Whoever makes the task opens
/// what it names, and gives the text in TaskInput::texts.
constexpr const char* kSensorKey = "sensor";

/// Whether a reference names a file, and not a preset.
constexpr bool IsSensorFile(std::string_view reference) { return reference != "v1" && reference != "v2"; }

}  // namespace etude
