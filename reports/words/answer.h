#pragma once

#include <string>
#include <vector>

#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {

/// Returns a scenario's answer in one line: how `method` compares with its baseline, and with the strongest other
/// method: "better than “fixed”; needs 140 × the solver steps of “gauss-newton”". If the method is worse and
/// its cost is at least twice the other method's, the line states the ratio of the costs instead of the verdict. If
/// no other method is compared, the line ends after the comparison with the baseline. If there is no verdict
/// generalised to other clips or people, the line says so.
std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric);

/// The ratio of two methods' costs: the smallest and the largest ratio over conditions.
struct CostRatio {
  double least = 0, most = 0;
};
std::optional<CostRatio> CostRatioOf(const std::vector<Judged>& judged);

/// Compares `method` by `metric` with its baseline, or with the strongest other method, over all conditions. Returns
/// the verdicts, and a sentence about the verdicts.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Returns the method that the question is about: the first method that is compared with another method; "" if no
/// methods are compared.
std::string MethodInQuestion(const ScenarioSummary& scenario);

}  // namespace etude
