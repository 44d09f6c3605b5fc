#pragma once

#include <cstdint>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Returns McNemar's mid-p of the worlds in which one of two methods alone succeeded (Fagerland, Lydersen & Laake
/// 2013): two-sided, 2 · P(B ≥ larger) − P(B = larger) with B ~ Binomial(gained + lost, ½), at most 1. 1 if both are 0.
double McNemarMidP(int gained, int lost);

/// Measure the answers of one condition: every method against its baseline, and against its strongest rival. Their
/// verdicts are left open, because they depend on the other conditions.
///
/// *Success*: the difference of Study::success in the worlds that neither skipped; a cell that failed counts 0, and a
/// world in which an answered cell has no value is left out. Where all values are 0 or 1 the test is McNemar's.
/// *Value*: the first headline metric that is not the success; what is measured here is that metric in the worlds in
/// which both succeeded, if success is yes or no and some world was lost. The comparison over all worlds, with failures
/// counted, stands in ConditionSummary::comparisons or ::rivals.
/// *Tail*: the share of worlds in which the method is far better minus that in which it is far worse, by more than
/// TailRule::times practical thresholds of the value's metric; not of shares.
std::vector<Answer> MeasureAnswersAgainstBaselines(const Study& study, const ConditionTable& table, std::uint64_t seed);
std::vector<Answer> MeasureAnswersAgainstRivals(const Study& study, const ConditionTable& table, std::uint64_t seed);

/// Returns the metric whose values an answer compares after success: the first other headline metric. "" if there is
/// none, or if success is the first headline metric and more than yes or no: then it is all that the answer is about.
std::string ValueMetricOf(const Study& study);

/// Compares the success of two methods under one condition, judged as the only comparison; nothing if no cell says it.
std::optional<Comparison> CompareSuccess(const Study& study, const ConditionTable& table, const std::string& method,
                                         const std::string& other, std::uint64_t seed);

/// Judges all answers of a study, after its comparisons were judged: each step's p-values are corrected over all
/// conditions and methods (Holm), those against baselines and those against rivals apart. An answer is the first of
/// these steps that is better or worse:
///   success   by at least Study::success_matters
///   value     the verdict over all worlds, unless that over the worlds where both succeeded is the opposite
///   tail      by at least Study::success_matters
/// Otherwise it is the value's verdict (success's without one), "no difference" only if success's is not open.
void JudgeAnswers(const Study& study, std::vector<ConditionSummary>& conditions);

}  // namespace etude
