#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/statistics/compare.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// One metric of two methods in the worlds of a condition; a world that was skipped for both is in none of these.
struct PairedWorlds {
  std::vector<Pair> pairs;  ///< both have a value
  std::vector<int> trials;  ///< of the pairs
  int only_baseline = 0, only_method = 0, neither = 0;
  /// Of only_method and only_baseline: the trials where the other's cell failed, rather than having no such metric.
  std::vector<int> baseline_failed, method_failed;
};

PairedWorlds PairsOf(const ConditionTable& table, const std::string& baseline, const std::string& method,
                     const std::string& metric);

/// Adds one world to `paired`.
void AddWorld(const MethodColumns& baseline, const MethodColumns& method, const std::string& metric, int trial,
              PairedWorlds& paired);

/// The same worlds with failures in the denominator: each in which one method alone failed counts as the largest
/// difference among the pairs, or one that just matters, against the method that failed (worst ranks, Lachin 1999).
/// Nothing when there is no such world, no pair, or no better direction.
std::optional<PairedWorlds> WithFailures(const PairedWorlds& paired, const MetricInfo& metric);

/// What keys the dice of a comparison: stable under adding methods, metrics or conditions.
std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method);

}  // namespace etude
