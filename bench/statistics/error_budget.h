#pragma once

#include <string>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

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
