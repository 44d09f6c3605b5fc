#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// "Does the coach notice which moves were performed right, and how soon?" One world: a learner's session
/// of built-in moves, right and wrong, and what a Kinect-like sensor saw of it.
TaskKind MakeDetectionTaskKind();

}  // namespace etude
