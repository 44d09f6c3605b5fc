#pragma once

#include <cstdint>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Returns McNemar's mid-p of the numbers of worlds in which only one of two methods succeeded (Fagerland, Lydersen &
/// Laake 2013): two-sided, 2 · P(B ≥ larger) − P(B = larger) with B ~ Binomial(gained + lost, ½), at most 1. 1 if both
/// are 0.
double McNemarMidP(int gained, int lost);

/// Measure the answers of one method under one condition: against its baseline, and against its strongest rival; nothing
/// if it has none. Their verdicts are left open, because they depend on the other conditions.
///
/// *Success*: the difference of Study::success in the worlds that neither skipped; a cell that failed counts 0, and a
/// world in which an answered cell has no value is left out. Where all values are 0 or 1 the test is McNemar's.
/// *Value*: the first headline metric that is not the success; this function compares it in the worlds where both
/// succeeded, if success is a yes or no and some worlds drop out. The comparison over all worlds, with failures
/// counted, is in ConditionSummary::comparisons or ::rivals. *Tail*: the share of worlds in which the method is far
/// better minus that in which it is far worse, by more than TailRule::times practical thresholds of the value's metric;
/// shares have no tail.
std::optional<Answer> MeasureAnswerAgainstBaseline(const Study& study, const ConditionTable& table,
                                                   const ComparedMethod& method, std::uint64_t seed);
std::optional<Answer> MeasureAnswerAgainstRival(const Study& study, const ConditionTable& table,
                                                const ComparedMethod& method, std::uint64_t seed);

/// Returns the metric that an answer compares besides success: the first headline metric that is not success. "" if
/// there is none, or if the first headline metric is success and not a yes-or-no value: then the answer compares
/// success alone.
std::string ValueMetricOf(const Study& study);

/// Compares the success of two methods under one condition, judged as the only comparison; nothing if no cell says it.
std::optional<Comparison> CompareSuccess(const Study& study, const ConditionTable& table, const std::string& method,
                                         const std::string& other, std::uint64_t seed);

/// Judges all answers of a study, after its comparisons were judged: each step's p-values are corrected over all
/// conditions and methods (Holm), separately for baselines and rivals. The first of these steps with a verdict "better"
/// or "worse" decides the answer:
///   success   by at least Study::success_matters
///   value     the verdict over all worlds, unless that over the worlds where both succeeded is the opposite
///   tail      by at least Study::success_matters
/// If no step decides, the answer is the verdict on the value, or on success if there is no value. It is "no
/// difference" only if the verdict on success is not open.
void JudgeAnswers(const Study& study, std::vector<ConditionSummary>& conditions);

}  // namespace etude
