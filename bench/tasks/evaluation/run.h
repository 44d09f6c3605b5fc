#pragma once

#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/evaluation/match.h"

namespace etude {

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> EvaluationMetrics();

/// Measures an answer.
CellResult JudgeMotion(const MatchedMotions& matched);

}  // namespace etude
