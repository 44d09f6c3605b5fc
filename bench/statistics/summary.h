#pragma once

#include <string>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/judging.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Returns the number of comparisons of methods with their baselines, which are judged together.
int CountComparisons(const Study& study);

/// The summary of one condition with its comparisons, before the comparisons of all conditions are judged together.
struct ConditionFindings {
  ConditionSummary summary;  ///< without comparisons; its answers are not judged yet
  std::vector<Question> against_baselines, against_rivals;
};
/// Measures one method under one condition; what belongs to no method is computed with the first. Random streams depend
/// only on what is compared, so this may be done in any order and by any process. Append joins the findings of a
/// condition's next method.
ConditionFindings MeasureMethod(const Study& study, const ConditionTable& table, std::size_t method,
                                std::uint64_t seed);
void Append(ConditionFindings more, ConditionFindings& findings);

/// Returns the summary of a study from the findings of all its conditions, in their order.
ScenarioSummary JudgeFindings(const Study& study, const ScenarioTable& table, std::vector<ConditionFindings> findings,
                              std::uint64_t seed);

/// Summarises one study's rows. Per condition and method: the aggregate of every metric with its interval, and the
/// share of cells that are ok. Then every method against its baseline on the headline metrics, judged as one family;
/// every method against the strongest other one (FindRival), judged as another family; and the verdict on each
/// expectation. The same rows and seed give the same bytes.
ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed);

/// Splits the final error into the cost of each stage, for methods under one condition that differ in `oracle` alone.
/// Returns one budget for each such family of two methods or more. Only worlds in which all methods of the family have
/// a value are used; intervals are bootstrap intervals of the mean over these worlds.
/// - If every subset of the stages is among the methods, and there are at most kMaxShapleyStages stages, a stage's
///   share is its Shapley value (Shapley 1953): the error that it saves, averaged over all orders in which stages are
///   replaced by the truth. Stages that interact share the saving equally.
/// - Otherwise the methods form a chain, each with further stages replaced by the truth; a share is what that step
///   saves, and depends on the order. Methods outside the chain are left out.
std::vector<ErrorBudget> ComputeErrorBudgets(const Study& study, const ConditionTable& table, const std::string& metric,
                                             std::uint64_t seed);

/// Families with more stages are treated as a chain, because Shapley values would need 2ⁿ methods.
constexpr std::size_t kMaxShapleyStages = 6;

}  // namespace etude
