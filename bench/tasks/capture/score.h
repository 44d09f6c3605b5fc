#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/exchange.h"
#include "bench/tasks/capture/run.h"

namespace etude {

/// Compares what every stage of a built-in method made with the truth of the world. `keeps_motion`: with a recording,
/// which keeps every stage of the `moments` (`StudioOptions`).
CellResult ScoreCaptureRun(const CaptureWorld& world, const CaptureRun& run, bool keeps_motion,
                           std::span<const double> moments = {});

/// Scores an answer of a method outside likewise; what only stages can tell is missing.
CellResult ScoreCaptureAnswer(const CaptureWorld& world, const CaptureAnswer& answer, bool keeps_motion);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> CaptureMetrics();

}  // namespace etude
