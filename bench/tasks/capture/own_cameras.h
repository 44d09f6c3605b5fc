#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/options.h"
#include "engine/base/result.h"

namespace etude {

/// The key of a condition that names a file of somebody's own cameras (`ReadRig`).
constexpr const char* kRigFileKey = "rig_file";

/// With `rig: file` the cameras of the calibration file that the condition names are `options.rig.own`.
Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options);

}  // namespace etude
