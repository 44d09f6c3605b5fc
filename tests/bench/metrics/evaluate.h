#pragma once

#include <optional>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Computes a metric for a test vector's input with the tasks' own functions; nothing if it has no value. Fails for an
/// unknown metric, and for input without the keys of MetricInfo::inputs.
Result<std::optional<double>> EvaluateMetric(std::string_view metric, std::string_view input_json);

}  // namespace etude
