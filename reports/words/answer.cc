#include "reports/words/answer.h"

#include <fmt/core.h>

#include "reports/words/figures.h"
#include "reports/words/sentence.h"
#include "reports/words/yardstick.h"

namespace etude {

MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against) {
  const std::vector<Judged> judged = JudgedOf(scenario, method, metric, against);
  if (judged.empty()) {
    MethodFinding finding{.method = method, .baseline = scenario.methods.front(), .unit = scenario.unit};
    finding.verdict = Verdict::kInconclusive;
    finding.sentence = fmt::format("“{}” was not compared by {}.", method, WordsFor(metric).label);
    return finding;
  }
  return {.method = method,
          .baseline = judged.front().comparison->baseline,
          .unit = scenario.unit,
          .is_compared = true,
          .verdict = CommonVerdict(judged),
          .beyond = BeyondInWords(judged, scenario.unit),
          .sentence = SentenceOf(judged, scenario.unit)};
}

std::string MethodInQuestion(const ScenarioSummary& scenario) {
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (!IsComparedWithNone(scenario, scenario.methods[i])) return scenario.methods[i];
  }
  return "";
}

}  // namespace etude
