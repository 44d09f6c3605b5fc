#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Draws every method's values of a metric under one condition, a row of dots each with its median (or mean) and
/// quartiles: whole distributions on one axis. "" when no cell has a value.
std::string StripsHtml(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                       const std::string& metric);

}  // namespace etude
