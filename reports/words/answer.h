#pragma once

#include <string>
#include <vector>

#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {

/// Writes a scenario's first line: how `method` did against its baseline, and against the strongest other method:
/// "better than “fixed”; needs 140 × the solver steps of “gauss-newton”". Where a cost is at least twice the other's,
/// the ratio says it, else the verdict. Without rivals it is the first half alone. Where nothing is known beyond these
/// worlds it says so.
std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric);

/// The ratio of a cost to another's; under several conditions the smallest and largest.
struct CostRatio {
  double least = 0, most = 0;
};
std::optional<CostRatio> CostRatioOf(const std::vector<Judged>& judged);

/// Puts into words how `method` did by `metric` against its baseline, or the strongest other method, over all
/// conditions.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Gives the method that the scenario's question is about, its second one (docs/scenarios.md); "" where only one ran.
std::string MethodInQuestion(const ScenarioSummary& scenario);

}  // namespace etude
