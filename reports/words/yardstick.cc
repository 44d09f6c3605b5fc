#include "reports/words/yardstick.h"

#include <algorithm>

namespace etude {

bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method) {
  // A scenario without metrics compares no method; that says nothing about this one.
  if (scenario.methods.empty() || method == scenario.methods.front()) return false;
  if (scenario.headline_metrics.empty() || scenario.conditions.empty()) return false;
  // A method that is compared at all is compared under every condition.
  const std::vector<Comparison>& comparisons = scenario.conditions.front().comparisons;
  return std::ranges::find(comparisons, method, &Comparison::method) == comparisons.end();
}

bool IsYardstick(const ScenarioSummary& scenario, const std::string& method) {
  if (!IsComparedWithNone(scenario, method)) return false;
  const std::vector<Comparison>& comparisons = scenario.conditions.front().comparisons;
  return std::ranges::find(comparisons, method, &Comparison::baseline) == comparisons.end();
}

std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method) {
  return IsYardstick(scenario, method) ? method + " (yardstick)" : method;
}

}  // namespace etude
