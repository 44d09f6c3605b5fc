#pragma once

#include <string_view>

namespace etude {

/// The key of a task that films with somebody's own cameras: a calibration file (`ReadRig`). Whoever makes the task
/// opens it, and gives its text in TaskInput::texts.
constexpr const char* kRigFileKey = "rig_file";

/// Whether a reference names a file: it can name nothing else.
constexpr bool IsRigFile(std::string_view reference) { return !reference.empty(); }

}  // namespace etude
