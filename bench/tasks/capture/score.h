#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/exchange.h"
#include "bench/tasks/capture/run.h"

namespace etude {

/// Compares the result of every stage of a built-in method with the truth. If `keeps_motion` is true and the method
/// found a skeleton, the cell gets a recording. `moments` are numbers of frames, counted from 1 (`StudioOptions`). For
/// these frames, the recording also contains the marks and the skeleton before inverse kinematics.
CellResult ScoreCaptureRun(const CaptureWorld& world, const CaptureRun& run, bool keeps_motion,
                           std::span<const double> moments = {});

/// Scores an answer of an outside method like the result of a built-in method. The metrics of a built-in method's
/// stages are missing.
CellResult ScoreCaptureAnswer(const CaptureWorld& world, const CaptureAnswer& answer, bool keeps_motion);

/// Returns the ids of all metrics that a cell reports, by a value or by the reason why the value is missing.
std::vector<std::string> CaptureMetrics();

}  // namespace etude
