#include "reports/words/judged.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "reports/words/figures.h"

namespace etude {
namespace {

/// Names of the sampling units, in the order of SamplingUnit: names for the units of this run, and for units that were
/// not run.
constexpr std::array<std::array<std::string_view, 2>, kSamplingUnits.size()> kUnitWords = {
    {{"these worlds", "other worlds"},
     {"these people", "other people"},
     {"these clips", "other clips"},
     {"these clips", "other clips"},
     {"these libraries", "other libraries"},
     {"these people", "other people"}}};

/// Returns the numbers behind a generalised verdict, which are the typical (pseudo-median) difference over sampling
/// units and the interval of this difference: "pseudo-median of 12 clips: −4.50 mm, 95 % CI −6.00 to −3.00".
std::string FiguresOf(const Beyond& beyond, const MetricWords& words, SamplingUnit unit) {
  if (!beyond.difference) return CountUnits(beyond.units, unit);
  std::string text = fmt::format("pseudo-median of {}: {}{}", CountUnits(beyond.units, unit),
                                 FormatNumber(*beyond.difference * words.scale), words.difference_suffix);
  if (beyond.low) text += ", 95 % CI " + FormatInterval(beyond.low, beyond.high, words);
  return text;
}

/// Returns the first known reason why a condition has no verdict for other sampling units; "" if none is known.
std::string WhyNone(const std::vector<Judged>& judged, SamplingUnit unit) {
  for (const Judged& j : judged) {
    const Beyond& beyond = j.comparison->beyond;
    if (!beyond.why_open.empty()) return beyond.why_open;
    if (beyond.units > 0) return "there are " + CountUnits(beyond.units, unit);
  }
  return "";
}

std::vector<Verdict> BeyondVerdictsOf(const std::vector<Judged>& judged) {
  std::vector<Verdict> verdicts;
  for (const Judged& j : judged) {
    if (const auto verdict = j.Elsewhere()) verdicts.push_back(*verdict);
  }
  return verdicts;
}

std::string VerdictsInWords(const std::vector<Judged>& judged, const std::vector<Verdict>& verdicts,
                            SamplingUnit unit) {
  if (judged.size() > 1) {
    std::string text = CountVerdicts(verdicts, judged.size());
    const std::size_t without = judged.size() - verdicts.size();
    return without == 0 ? text : fmt::format("{}, no verdict under {} of {}", text, without, judged.size());
  }
  const Beyond& beyond = judged.front().comparison->beyond;
  const std::string why =
      verdicts.front() == Verdict::kUndecided && !beyond.why_open.empty() ? ": " + beyond.why_open : std::string();
  return fmt::format("{} ({}){}", VerdictName(verdicts.front()),
                     FiguresOf(beyond, WordsFor(judged.front().comparison->metric), unit), why);
}

}  // namespace

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

std::vector<Judged> AnswersOf(const ScenarioSummary& scenario, const std::string& method, Against against) {
  std::vector<Judged> found;
  for (const ConditionSummary& condition : scenario.conditions) {
    const bool is_rival = against == Against::kRival;
    for (const Answer& answer : is_rival ? condition.rival_answers : condition.answers) {
      if (answer.method != method) continue;
      const std::vector<Comparison>& values = is_rival ? condition.rivals : condition.comparisons;
      const auto value = std::ranges::find_if(
          values, [&](const Comparison& c) { return c.method == method && c.metric == answer.value_metric; });
      const bool by_success =
          answer.success && (answer.decided_by == AnswerStep::kSuccess || value == values.end() || value->pairs == 0);
      if (!by_success && value == values.end()) continue;
      const Comparison& judged = by_success ? *answer.success : *value;
      // The two intervals of one difference come from different random numbers; show only one of them.
      const auto same = std::ranges::find_if(values, [&](const Comparison& c) {
        return c.method == judged.method && c.metric == judged.metric && c.pairs == judged.pairs &&
               c.difference == judged.difference;
      });
      found.push_back({same == values.end() ? &judged : &*same, &condition, &answer});
    }
  }
  if (!found.empty() || scenario.headline_metrics.empty()) return found;
  return JudgedOf(scenario, method, scenario.headline_metrics.front(), against);
}

std::vector<Judged> QuestionOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                               Against against) {
  const bool is_answer = !scenario.headline_metrics.empty() && scenario.headline_metrics.front() == metric;
  return is_answer ? AnswersOf(scenario, method, against) : JudgedOf(scenario, method, metric, against);
}

std::vector<Judged> ValuesBeside(const ScenarioSummary& scenario, const std::vector<Judged>& judged, Against against) {
  const Answer* answer = judged.front().answer;
  if (answer == nullptr || answer->decided_by != AnswerStep::kSuccess || answer->value_metric.empty()) return {};
  return JudgedOf(scenario, answer->method, answer->value_metric, against);
}

bool IsDecidedByTail(const Judged& judged) {
  return judged.answer != nullptr && judged.answer->decided_by == AnswerStep::kTail;
}

bool MeanTellsMore(const Comparison& c) {
  return c.mean && c.ci_low && c.ci_high && (*c.mean < *c.ci_low || *c.mean > *c.ci_high);
}

const Answer* FindTailAnswer(const ConditionSummary& condition, const Comparison& comparison) {
  for (const auto* answers : {&condition.answers, &condition.rival_answers}) {
    for (const Answer& answer : *answers) {
      if (answer.decided_by == AnswerStep::kTail && answer.value_metric == comparison.metric &&
          answer.method == comparison.method && answer.baseline == comparison.baseline) {
        return &answer;
      }
    }
  }
  return nullptr;
}

Comparison AsAnswered(const ConditionSummary& condition, const Comparison& comparison) {
  const Answer* answer = FindTailAnswer(condition, comparison);
  if (answer == nullptr) return comparison;
  Comparison shown = comparison;
  shown.verdict = answer->verdict;
  shown.why_open = "the tail decides: " + TailInWords(*answer);
  shown.beyond.verdict = answer->beyond;
  shown.beyond.why_open = answer->tail->beyond.why_open;
  return shown;
}

std::string TailInWords(const Answer& answer) {
  const Comparison& tail = *answer.tail;
  const bool worse = answer.verdict == Verdict::kWorse;
  return fmt::format("far {} in {} of {}, far {} in {}", worse ? "worse" : "better", worse ? tail.worse : tail.better,
                     Plural(tail.pairs, "world"), worse ? "better" : "worse", worse ? tail.better : tail.worse);
}

bool HaveOneMetric(const std::vector<Judged>& judged) {
  return std::ranges::all_of(
      judged, [&](const Judged& j) { return j.comparison->metric == judged.front().comparison->metric; });
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
  const Verdict first = judged.front().Here();
  const bool agree = std::ranges::all_of(judged, [&](const Judged& j) { return j.Here() == first; });
  return agree ? std::optional(first) : std::nullopt;
}

std::string AllConditions(std::size_t count) {
  return count == 2 ? "both conditions" : fmt::format("all {} conditions", count);
}

std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions) {
  std::string text;
  for (const Verdict verdict : {Verdict::kBetter, Verdict::kWorse, Verdict::kNoDifference, Verdict::kUndecided}) {
    const auto count = static_cast<std::size_t>(std::ranges::count(verdicts, verdict));
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} under {}", VerdictName(verdict),
                        count == conditions ? AllConditions(count) : fmt::format("{} of {}", count, conditions));
  }
  return text;
}

std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged) {
  std::vector<Verdict> verdicts;
  for (const Judged& j : judged) verdicts.push_back(j.Here());
  return verdicts;
}

bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method) {
  // Without metrics, no methods are compared, and no method counts as a yardstick.
  if (scenario.methods.empty() || method == scenario.methods.front()) return false;
  if (scenario.headline_metrics.empty() || scenario.conditions.empty()) return false;
  // A compared method is compared under every condition, so it suffices to look at the first condition.
  const std::vector<Comparison>& comparisons = scenario.conditions.front().comparisons;
  return std::ranges::find(comparisons, method, &Comparison::method) == comparisons.end();
}

bool IsYardstick(const ScenarioSummary& scenario, const std::string& method) {
  if (!IsComparedWithNone(scenario, method)) return false;
  const std::vector<Comparison>& comparisons = scenario.conditions.front().comparisons;
  return std::ranges::find(comparisons, method, &Comparison::baseline) == comparisons.end();
}

std::size_t IndexOf(const ScenarioSummary& scenario, const std::string& method) {
  return static_cast<std::size_t>(std::ranges::find(scenario.methods, method) - scenario.methods.begin());
}

std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method) {
  return IsYardstick(scenario, method) ? method + " (yardstick)" : method;
}

std::string_view TheseUnits(SamplingUnit unit) { return kUnitWords[static_cast<std::size_t>(unit)][0]; }

std::string_view OtherUnits(SamplingUnit unit) { return kUnitWords[static_cast<std::size_t>(unit)][1]; }

BeyondFinding BeyondInWords(const std::vector<Judged>& judged, SamplingUnit unit) {
  BeyondFinding finding;
  const std::vector<Verdict> verdicts = BeyondVerdictsOf(judged);
  if (verdicts.empty()) {
    const std::string why = WhyNone(judged, unit);
    finding.words = fmt::format("on {} only{}", TheseUnits(unit), why.empty() ? "" : fmt::format(" ({})", why));
    return finding;
  }
  finding.on_these_only = false;
  if (std::ranges::all_of(verdicts, [&](Verdict v) { return v == verdicts.front(); })) finding.verdict = verdicts[0];
  finding.as_on_these = verdicts == VerdictsOf(judged);
  finding.words = WorldsAreUnits(unit) && finding.as_on_these
                      ? fmt::format("for {} of the same kind: the same verdict", OtherUnits(unit))
                      : fmt::format("for {}: {}", OtherUnits(unit), VerdictsInWords(judged, verdicts, unit));
  return finding;
}

std::string ShortBeyond(const Comparison& comparison, SamplingUnit unit) {
  const Beyond& beyond = comparison.beyond;
  if (beyond.verdict) return std::string(VerdictName(*beyond.verdict));
  return fmt::format("on {} only{}", TheseUnits(unit),
                     beyond.units > 0 ? fmt::format(" ({})", CountUnits(beyond.units, unit)) : "");
}

}  // namespace etude
