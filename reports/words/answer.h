#pragma once

#include <string>
#include <vector>

#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {

/// Returns a scenario's first line: how `method` did against its baseline, and against the strongest other method:
/// "better than “fixed”; needs 140 × the solver steps of “gauss-newton”". If a cost is at least twice the other's, it
/// gives the ratio, else the verdict. Without rivals it has the first half only. It says so if nothing is known beyond
/// these worlds.
std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric);

/// One method's cost divided by another's: the smallest and largest ratio over conditions.
struct CostRatio {
  double least = 0, most = 0;
};
std::optional<CostRatio> CostRatioOf(const std::vector<Judged>& judged);

/// Returns in words how `method` did by `metric` against its baseline, or the strongest other method, over all
/// conditions.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Returns the method that the question is about: the first one that is compared with another; "" if none is.
std::string MethodInQuestion(const ScenarioSummary& scenario);

}  // namespace etude
