#include "reports/words/judged.h"

#include <fmt/core.h>

#include <algorithm>

namespace etude {

std::vector<Judged> JudgedOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against) {
  std::vector<Judged> found;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const Comparison& c : against == Against::kBaseline ? condition.comparisons : condition.rivals) {
      if (c.method == method && c.metric == metric) found.push_back({&c, &condition});
    }
  }
  return found;
}

std::vector<std::string> BaselinesOf(const Judged& judged) {
  const std::vector<MethodSummary>& methods = judged.condition->methods;
  const std::string& baseline = judged.comparison->baseline;
  const auto is_method = [&](const std::string& name) {
    return std::ranges::find(methods, name, &MethodSummary::method) != methods.end();
  };
  constexpr std::string_view kOr = " or ";
  for (std::size_t at = baseline.find(kOr); at != std::string::npos; at = baseline.find(kOr, at + 1)) {
    const std::string first = baseline.substr(0, at), second = baseline.substr(at + kOr.size());
    if (!is_method(baseline) && is_method(first) && is_method(second)) return {first, second};
  }
  return {baseline};
}

std::string OthersOf(const std::vector<Judged>& judged) {
  std::vector<std::string> names;
  std::string text;
  for (const Judged& j : judged) {
    for (const std::string& name : BaselinesOf(j)) {
      if (std::ranges::find(names, name) != names.end()) continue;
      text += fmt::format("{}“{}”", names.empty() ? "" : " or ", name);
      names.push_back(name);
    }
  }
  return text;
}

std::optional<Verdict> CommonVerdict(const std::vector<Judged>& judged) {
  const Verdict first = judged.front().comparison->verdict;
  const bool agree = std::ranges::all_of(judged, [&](const Judged& j) { return j.comparison->verdict == first; });
  return agree ? std::optional(first) : std::nullopt;
}

std::string AllConditions(std::size_t count) {
  return count == 2 ? "both conditions" : fmt::format("all {} conditions", count);
}

std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions) {
  std::string text;
  for (const Verdict verdict : {Verdict::kBetter, Verdict::kWorse, Verdict::kNoDifference, Verdict::kInconclusive}) {
    const auto count = static_cast<std::size_t>(std::ranges::count(verdicts, verdict));
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} under {}", VerdictName(verdict),
                        count == conditions ? AllConditions(count)
                                            : fmt::format("{} of {}", count, conditions));
  }
  return text;
}

std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged) {
  std::vector<Verdict> verdicts;
  for (const Judged& j : judged) verdicts.push_back(j.comparison->verdict);
  return verdicts;
}

}  // namespace etude
