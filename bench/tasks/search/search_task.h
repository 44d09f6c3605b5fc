#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// The task `search`: how does finding matching frames grow with the library?
TaskKind MakeSearchTaskKind();

}  // namespace etude
