#pragma once

#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"

namespace etude {

/// What becomes of the comparisons with baselines when a verdict only counts if it is the same under every value of
/// Study::across: one for each comparison and each condition of all that is swept otherwise, in the order of
/// `conditions`. None where the study asks for nothing.
std::vector<AcrossVerdict> JudgeAcross(const Study& study, const std::vector<ConditionSummary>& conditions);

}  // namespace etude
