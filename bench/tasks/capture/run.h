#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/stages.h"
#include "bench/tasks/capture/exchange.h"

namespace etude {

/// Runs one method in one world and measures it. `keeps_motion`: with a recording (recording_extras.h).
CellResult RunCaptureCell(CaptureStages& stages, const CaptureMethod& method, bool keeps_motion);

/// Scores an answer of a method outside likewise; its recording shows no masks, its BVH file no turning joints.
CellResult ScoreCaptureAnswer(const CaptureWorld& world, const CaptureAnswer& answer, bool keeps_motion);

}  // namespace etude
