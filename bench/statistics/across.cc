#include "bench/statistics/across.h"

#include <algorithm>
#include <string>

namespace etude {
namespace {

/// A condition in two parts: the values that a verdict must hold for, and the rest.
struct SplitCondition {
  std::vector<SweptValue> across, rest;
};

SplitCondition Split(const Study& study, const std::vector<SweptValue>& condition) {
  SplitCondition split;
  for (const SweptValue& value : condition) {
    const bool named = std::ranges::find(study.across, value.key) != study.across.end();
    (named ? split.across : split.rest).push_back(value);
  }
  return split;
}

bool IsSameQuestion(const AcrossVerdict& verdict, const std::vector<SweptValue>& rest, const Comparison& comparison) {
  return verdict.condition == rest && verdict.metric == comparison.metric && verdict.method == comparison.method &&
         verdict.baseline == comparison.baseline;
}

}  // namespace

std::vector<AcrossVerdict> JudgeAcross(const Study& study, const std::vector<ConditionSummary>& conditions) {
  std::vector<AcrossVerdict> verdicts;
  if (study.across.empty()) return verdicts;
  for (const ConditionSummary& condition : conditions) {
    const SplitCondition split = Split(study, condition.condition);
    for (const Comparison& comparison : condition.comparisons) {
      auto found = std::ranges::find_if(
          verdicts, [&](const AcrossVerdict& verdict) { return IsSameQuestion(verdict, split.rest, comparison); });
      if (found == verdicts.end()) {
        found = verdicts.insert(found, {.condition = split.rest,
                                        .metric = comparison.metric,
                                        .baseline = comparison.baseline,
                                        .method = comparison.method,
                                        .each = {},
                                        .verdict = comparison.verdict});
      }
      found->each.push_back({ConditionLabel(split.across), comparison.verdict, comparison.difference});
      if (found->verdict != comparison.verdict) found->verdict = Verdict::kInconclusive;
    }
  }
  return verdicts;
}

}  // namespace etude
