#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/plausibility/options.h"
#include "io/clips/body_in_place.h"

namespace etude {

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> PlausibilityMetrics();
/// Returns the ids of the metrics that may have limits. For these metrics, lower is better.
std::vector<std::string> LimitedMetrics();

/// Measures the faults of a body. The reason of the result describes the limits that are exceeded, the faults
/// (FaultSentences), the floor, and the changes made by the reader. The result's status is failed if there are fewer
/// than kMinFramesForFaults frames. With `keeps_motion`, the body is recorded with its faults.
CellResult JudgeAlone(BodyInPlace body, const PlausibilityOptions& options, bool keeps_motion = false);

/// Returns the part of a reason of JudgeAlone that describes limits and faults.
std::string_view FaultWords(std::string_view reason);

}  // namespace etude
