#pragma once

#include <vector>

#include "reports/words/findings.h"

namespace etude {

/// Puts into words how `method` did against its baseline by `metric`, over all conditions.
MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric);

/// The answer to the scenario's question, which is about its second method (docs/scenarios.md).
MethodFinding AnswerInWords(const ScenarioSummary& scenario, const std::string& metric);

}  // namespace etude
