#pragma once

#include <string>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/judging.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Returns the number of comparisons of methods with their baselines. All these comparisons are judged as one family.
int CountComparisons(const Study& study);

/// The summary of one condition and its comparisons, before the comparisons of all conditions are judged together.
struct ConditionFindings {
  ConditionSummary summary;  ///< without comparisons; its answers are not judged yet
  std::vector<Question> against_baselines, against_rivals;
};
/// Measures one method under one condition. Results that belong to no single method are computed with the study's first
/// method. Random streams depend only on the things compared, so methods and conditions may be measured in any order
/// and by any process. Append adds the findings of a condition's next method.
ConditionFindings MeasureMethod(const Study& study, const ConditionTable& table, std::size_t method,
                                std::uint64_t seed);
void Append(ConditionFindings more, ConditionFindings& findings);

/// Returns the summary of a study. `findings` has one entry per condition of the study, in the order of the conditions.
ScenarioSummary JudgeFindings(const Study& study, const ScenarioTable& table, std::vector<ConditionFindings> findings,
                              std::uint64_t seed);

/// Summarises the rows of one study. Per condition and method, it computes the aggregate of every metric with its
/// interval, and the share of ok cells. It compares every method with its baseline, and every method with its strongest
/// rival (FindRival), on the headline metrics; the p values of each of these two families of comparisons are corrected
/// together. It judges every expectation. The same rows and seed give the same bytes.
ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed);

/// Splits the final error into the cost of each stage, for methods under one condition that differ only in `oracle`.
/// Returns one budget for each such family of at least two methods. Only worlds in which all methods of the family have
/// a value are used. Intervals are bootstrap intervals of the mean over these worlds.
/// - If every subset of the stages is among the methods, and there are at most kMaxShapleyStages stages, a stage's
///   share is its Shapley value (Shapley 1953): the reduction of the error when the truth replaces the stage, averaged
///   over all orders of replacement. Stages that interact share their common reduction equally.
/// - Otherwise the methods form a chain, in which each method has more stages replaced by the truth than the one
///   before. A share is the reduction of the error in one step of the chain, and depends on the order. Methods outside
///   the chain are left out.
std::vector<ErrorBudget> ComputeErrorBudgets(const Study& study, const ConditionTable& table, const std::string& metric,
                                             std::uint64_t seed);

/// The largest number of stages for Shapley values, which need 2ⁿ methods. Families with more stages are treated as a
/// chain.
constexpr std::size_t kMaxShapleyStages = 6;

}  // namespace etude
