#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// "How close does the skeleton from two cameras come to the truth?": paper B's whole pipeline on rendered
/// pictures of a clip.
TaskKind MakeCaptureTaskKind();

}  // namespace etude
