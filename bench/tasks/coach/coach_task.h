#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

TaskKind MakeCoachTaskKind();

}  // namespace etude
