#include "bench/statistics/select.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace etude {

void AddWorld(const MethodColumns& baseline, const MethodColumns& method, const std::string& metric, int trial,
              PairedWorlds& paired) {
  const auto skipped = [&](const MethodColumns& columns) {
    return columns.StatusAt(trial).value_or(Status::kSkipped) == Status::kSkipped;
  };
  const auto failed = [&](const MethodColumns& columns) {
    return !skipped(columns) && columns.StatusAt(trial) != Status::kOk;
  };
  const auto of_baseline = baseline.ValueAt(metric, trial), of_method = method.ValueAt(metric, trial);
  if (of_baseline && of_method) {
    paired.pairs.push_back({*of_baseline, *of_method});
    paired.trials.push_back(trial);
  } else if (of_baseline) {
    ++paired.only_baseline;
    if (failed(method)) paired.method_failed.push_back(trial);
  } else if (of_method) {
    ++paired.only_method;
    if (failed(baseline)) paired.baseline_failed.push_back(trial);
  } else if (!skipped(baseline) || !skipped(method)) {
    ++paired.neither;
  }
}

PairedWorlds PairsOf(const ConditionTable& table, const std::string& baseline, const std::string& method,
                     const std::string& metric) {
  PairedWorlds paired;
  const MethodColumns &of_baseline = table.Of(baseline), &of_method = table.Of(method);
  for (int trial = 0; trial < table.trials(); ++trial) AddWorld(of_baseline, of_method, metric, trial, paired);
  return paired;
}

std::optional<PairedWorlds> WithFailures(const PairedWorlds& paired, const MetricInfo& metric) {
  const bool all_answered = paired.baseline_failed.empty() && paired.method_failed.empty();
  if (all_answered || paired.pairs.empty() || metric.direction == Direction::kNeither) return std::nullopt;
  double largest = AreShares(paired.pairs) ? 1 : metric.practical;
  for (const Pair& pair : paired.pairs) largest = std::max(largest, std::abs(pair.method - pair.baseline));
  const bool lower = metric.direction == Direction::kLowerIsBetter;
  const Pair loss = lower ? Pair{0, largest} : Pair{largest, 0}, win{loss.method, loss.baseline};
  PairedWorlds all = paired;
  all.pairs.insert(all.pairs.end(), paired.method_failed.size(), loss);
  all.pairs.insert(all.pairs.end(), paired.baseline_failed.size(), win);
  all.trials.insert(all.trials.end(), paired.method_failed.begin(), paired.method_failed.end());
  all.trials.insert(all.trials.end(), paired.baseline_failed.begin(), paired.baseline_failed.end());
  return all;
}

std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method) {
  return fmt::format("{}/{}/{}/{}/{}", scenario, ConditionLabel(condition), metric, baseline, method);
}

}  // namespace etude
