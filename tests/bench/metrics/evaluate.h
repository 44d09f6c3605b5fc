#pragma once

#include <optional>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Computes a metric for the input of a test vector, with the functions that the tasks use; nothing if the metric has
/// no value. Fails if the metric has no function here, or if the input does not fit the metric (its keys are
/// MetricInfo::inputs).
Result<std::optional<double>> EvaluateMetric(std::string_view metric, std::string_view input_json);

}  // namespace etude
