#pragma once

#include <cstdint>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// PairedTest::how of McNemarMidP.
inline constexpr const char* kMidP = "McNemar's mid-p";

/// Returns McNemar's mid-p value (Fagerland, Lydersen & Laake 2013). `gained` and `lost` are the numbers of worlds in
/// which only one of two methods succeeded. The p is two-sided: 2 · P(B ≥ larger) − P(B = larger) with B ~
/// Binomial(gained + lost, ½), at most 1. It is 1 if both numbers are 0.
double McNemarMidP(int gained, int lost);

/// These functions measure the answer of one method under one condition, compared with its baseline or with its
/// strongest rival. They return nothing if the method has no baseline or rival. The verdicts are left open, because
/// they depend on the other conditions.
///
/// *Success* is the difference of Study::success in the worlds that neither method skipped. A cell that failed counts
/// 0; a world in which a cell with status ok has no value is left out. If all values are 0 or 1, the test is McNemar's.
/// *Value* is the first headline metric that is not the success. If success is a yes-or-no value and a method failed in
/// some world, the values are compared here in the worlds in which both methods succeeded. The comparison over all
/// worlds, with failures counted, is in ConditionSummary::comparisons or ::rivals. *Tail* is the share of worlds in
/// which the method is far better, minus the share in which it is far worse. "Far" means by more than TailRule::times
/// practical thresholds of the value's metric. Shares have no tail.
std::optional<Answer> MeasureAnswerAgainstBaseline(const Study& study, const ConditionTable& table,
                                                   const ComparedMethod& method, std::uint64_t seed);
std::optional<Answer> MeasureAnswerAgainstRival(const Study& study, const ConditionTable& table,
                                                const ComparedMethod& method, std::uint64_t seed);

/// Returns the metric that an answer compares in addition to success: the first headline metric that is not success.
/// Returns "" if there is none, or if the first headline metric is success and not a yes-or-no value; the answer then
/// compares success alone.
std::string ValueMetricOf(const Study& study);

/// Returns the number of worlds below which no answer of a study can have the verdict "better" or "worse". With fewer
/// worlds, even the smallest possible p of each step, corrected over its family (Holm), is above 5 %. The number is at
/// least kMinSample, because fewer values have no interval.
int WorldsNeeded(const Study& study);

/// Compares the success of two methods under one condition, and judges this comparison as if it were the only one.
/// Returns nothing if no cell has a value of the success metric.
std::optional<Comparison> CompareSuccess(const Study& study, const ConditionTable& table, const std::string& method,
                                         const std::string& other, std::uint64_t seed);

/// Judges all answers of a study. The study's comparisons must have been judged before (JudgeFamily). The p-values of
/// each step (success, value, tail) are corrected over all conditions and methods (Holm), separately for baselines and
/// rivals. The first of these steps with a verdict "better" or "worse" decides the answer:
///   success   by at least Study::success_matters
///   value     the verdict over all worlds, unless the verdict over the worlds where both succeeded contradicts it
///   tail      by at least TailRule::share
/// If no step decides, the answer is the verdict on the value, or on success if there is no value. The answer is "no
/// difference" only if the verdict on success is not open.
void JudgeAnswers(const Study& study, std::vector<ConditionSummary>& conditions);

}  // namespace etude
