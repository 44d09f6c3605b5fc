#pragma once

#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/evaluation/match.h"
#include "bench/tasks/evaluation/side_files.h"

namespace etude {

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> EvaluationMetrics();

/// Data that some metrics need in addition to the motions.
struct EvaluationSideData {
  std::optional<StatisticsByJoint> statistics;
  std::optional<std::vector<double>> music_beats_s;
};

/// Measures all metrics of an answer.
CellResult JudgeMotion(const MatchedMotions& matched, const EvaluationSideData& side = {});

}  // namespace etude
