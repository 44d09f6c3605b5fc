#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// "How well does a distance know that two poses look alike?" One world: one of eight authored pairs of poses, or some
/// hundreds of pairs of frames of two clips.
TaskKind MakePoseDistanceTaskKind();

}  // namespace etude
