#pragma once

#include <string>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/judging.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// The number of comparisons of methods with their baselines that are judged together.
int CountComparisons(const Study& study);

/// The summary of one condition and its comparisons, before these are judged together with those of all others.
struct ConditionFindings {
  ConditionSummary summary;  ///< without comparisons
  std::vector<Question> against_baselines, against_rivals;
};
/// Seeded by what is measured alone: conditions may be measured in any order, and anywhere.
ConditionFindings MeasureCondition(const Study& study, const ConditionTable& table, std::uint64_t seed);

/// The summary of a study from the findings of all its conditions, in their order.
ScenarioSummary JudgeFindings(const Study& study, const ScenarioTable& table, std::vector<ConditionFindings> findings,
                              std::uint64_t seed);

/// Sums up one study's rows: per condition and method the aggregate of every metric with its
/// interval and its share of cells that are ok, every method against its baseline on the headline metrics, judged
/// as one family, every method against the strongest other one (FindRival), judged as another, and the verdict on each
/// expectation. Seeded, so the same rows give the same bytes.
ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed);

/// Splits the final error into what every stage costs, for methods under one condition that differ in `oracle` alone:
/// one budget for each such family of two methods or more. Values are those of the worlds in which all of them have
/// one; intervals are bootstrap intervals of the mean over these worlds.
/// - Where every subset of the stages is among the methods, a stage's share is its Shapley value: what it saves,
///   averaged over all orders in which stages are made true (Shapley 1953), so that stages that interact share alike.
///   At most kMostShapleyStages stages.
/// - Else the methods are a chain, each the one before with further stages true; a share is what that step saves, and
///   depends on the order. Methods beside the chain are left out.
std::vector<ErrorBudget> ComputeErrorBudgets(const Study& study, const ConditionTable& table, const std::string& metric,
                                             std::uint64_t seed);

constexpr std::size_t kMostShapleyStages = 6;

}  // namespace etude
