#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// "How smoothly does a body get from one clip into another when called?" One world: two clips of the
/// library and the moment at which the second is asked for.
TaskKind MakeTransitionTaskKind();

}  // namespace etude
