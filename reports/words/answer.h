#pragma once

#include <string>

#include "reports/words/findings.h"

namespace etude {

/// Puts into words how `method` did by `metric` against its baseline, or the strongest other method, over all
/// conditions.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// The method that the scenario's question is about, its second one (docs/scenarios.md); "" where only one ran.
std::string MethodInQuestion(const ScenarioSummary& scenario);

}  // namespace etude
