#pragma once

#include <optional>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A metric's value for the input of a test vector, by the functions that the tasks measure with; nothing where the
/// metric has no value. Fails when the metric has no such function, or the input is not one of its own (its keys are
/// MetricInfo::inputs).
Result<std::optional<double>> EvaluateMetric(std::string_view metric, std::string_view input_json);

}  // namespace etude
