#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// "How smoothly can a dancer be called from one clip into another?" One world: two clips of the
/// library and the moment at which the second is asked for.
TaskKind MakeTransitionTaskKind();

}  // namespace etude
