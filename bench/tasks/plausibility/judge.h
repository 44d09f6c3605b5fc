#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/plausibility/options.h"
#include "io/clips/body_in_place.h"

namespace etude {

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> PlausibilityMetrics();
/// Returns those that may have limits: the lower, the better.
std::vector<std::string> LimitedMetrics();

/// Measures the faults of a body. The reason of the result holds, in words, the limits that are exceeded, the faults
/// (FaultSentences), the floor, and what the reader did. Fails with fewer frames than faults are sought in.
/// If `keeps_motion`, the body is recorded with its faults.
CellResult JudgeAlone(BodyInPlace body, const PlausibilityOptions& options, bool keeps_motion = false);

/// Returns the part of that reason about limits and faults.
std::string_view FaultWords(std::string_view reason);

}  // namespace etude
