#pragma once

#include <string>
#include <vector>

#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {

/// Returns a scenario's first line: how `method` compares with its baseline, and with the strongest other method:
/// "better than “fixed”; needs 140 × the solver steps of “gauss-newton”". If one cost is at least twice the other, the
/// line gives the ratio, else the verdict. Without rivals, the line ends after the baseline. If there is no verdict for
/// other units, the line says so.
std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric);

/// One method's cost divided by another's: the smallest and largest ratio over conditions.
struct CostRatio {
  double least = 0, most = 0;
};
std::optional<CostRatio> CostRatioOf(const std::vector<Judged>& judged);

/// Compares `method` by `metric` with its baseline, or with the strongest other method, over all conditions; returns
/// the finding in words.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Returns the method that the question is about: the first method that is compared with another one; "" if no methods
/// are compared.
std::string MethodInQuestion(const ScenarioSummary& scenario);

}  // namespace etude
