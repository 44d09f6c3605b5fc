#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// Inverse kinematics along clips: does a solver keep up with a motion when a frame has only so many steps, and each
/// begins at the answer to the one before?
TaskKind MakeTrackingTaskKind();

}  // namespace etude
