#include "reports/words/answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/words/figures.h"
#include "reports/words/yardstick.h"

namespace etude {
namespace {

struct Judged {
  const Comparison* comparison;
  const ConditionSummary* condition;
};

std::vector<Judged> ComparisonsOf(const ScenarioSummary& scenario, const std::string& method,
                                  const std::string& metric) {
  std::vector<Judged> found;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const Comparison& comparison : condition.comparisons) {
      if (comparison.method == method && comparison.metric == metric) found.push_back({&comparison, &condition});
    }
  }
  return found;
}

int CountOf(const std::vector<Judged>& judged, Verdict verdict) {
  return static_cast<int>(
      std::ranges::count_if(judged, [&](const Judged& j) { return j.comparison->verdict == verdict; }));
}

std::string Amount(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + words.difference_suffix;
}

// "58 of 60 worlds", or a share when ties (which count half) leave no whole number.
std::string WorldsWon(double share, int pairs) {
  const double won = share * pairs;
  if (std::abs(won - std::round(won)) < 1e-6) {
    return fmt::format("{} of {}", FormatCount(std::llround(won)), Plural(pairs, "world"));
  }
  return fmt::format("{:.0f} % of {}", 100 * share, Plural(pairs, "world"));
}

std::string_view VerbFor(double difference, const MetricWords& words) {
  if (words.direction == Direction::kNeither) return "changes";
  return difference < 0 ? "lowers" : "raises";
}

std::string ClearSentence(const Comparison& c, const MetricWords& words) {
  const double difference = *c.difference;
  const bool worse = c.verdict == Verdict::kWorse;
  const std::string worlds = WorldsWon(worse ? 1 - c.share_better : c.share_better, c.pairs);
  if (difference == 0) {
    return fmt::format("“{}” has the {} {} than “{}” on {}, with equal halves on the others — {}.", c.method,
                       worse ? "worse" : "better", words.label, c.baseline, worlds, VerdictName(c.verdict));
  }
  // "Lowers by 12.3 (10.1–14.0)": the verb carries the sign, so the interval is turned with it.
  std::optional<double> low = c.ci_low, high = c.ci_high;
  if (difference < 0 && low && high) {
    low = -*c.ci_high;
    high = -*c.ci_low;
  }
  return fmt::format("“{}” {} the {} by {} (95 % CI {}) compared with “{}”, on {} — {}.", c.method,
                     VerbFor(difference, words), words.label, Amount(std::abs(difference), words),
                     FormatInterval(low, high, words), c.baseline, worlds, VerdictName(c.verdict));
}

std::string SentenceFor(const Comparison& c, const MetricWords& words) {
  if (c.pairs == 0 || !c.difference) {
    return fmt::format("“{}” could not be compared with “{}” by {}: no world gave both a value — inconclusive.",
                       c.method, c.baseline, words.label);
  }
  if (!c.ci_low) {
    return fmt::format("“{}” and “{}” met in {} only: too few to judge the {} — inconclusive.", c.method, c.baseline,
                       Plural(c.pairs, "world"), words.label);
  }
  const std::string figures = fmt::format("typical change {} (95 % CI {}) on {}", Amount(*c.difference, words),
                                          FormatInterval(c.ci_low, c.ci_high, words), Plural(c.pairs, "world"));
  switch (c.verdict) {
    case Verdict::kBetter:
    case Verdict::kWorse:
      return ClearSentence(c, words);
    case Verdict::kNoDifference:
      return fmt::format("“{}” makes no difference that matters to the {} compared with “{}”: {} — no difference.",
                         c.method, words.label, c.baseline, figures);
    case Verdict::kInconclusive:
      break;
  }
  return fmt::format("These worlds do not settle whether “{}” changes the {} compared with “{}”: {} — inconclusive{}.",
                     c.method, words.label, c.baseline, figures, c.why_open.empty() ? "" : ": " + c.why_open);
}

// "by 5.1° (noise=5) to 12.3° (noise=20)"
std::string RangeOfChanges(const std::vector<Judged>& judged, const MetricWords& words) {
  std::vector<Judged> known;
  std::ranges::copy_if(judged, std::back_inserter(known),
                       [](const Judged& j) { return j.comparison->difference.has_value(); });
  if (known.empty()) return "";
  const auto [smallest, largest] =
      std::ranges::minmax_element(known, {}, [](const Judged& j) { return std::abs(*j.comparison->difference); });
  const auto end = [&](const Judged& j) {
    return fmt::format("{} ({})", Amount(*j.comparison->difference, words), ConditionLabel(j.condition->condition));
  };
  return fmt::format(": typical change {} to {}", end(*smallest), end(*largest));
}

// All conditions agree that it is better, or worse: "lowers the error under both conditions".
std::string ClearSentenceOverConditions(const std::vector<Judged>& judged, const MetricWords& words) {
  const Comparison& first = *judged.front().comparison;
  const std::string all = judged.size() == 2 ? "both" : fmt::format("all {}", judged.size());
  return fmt::format("“{}” {} the {} compared with “{}” under {} conditions{} — {}.", first.method,
                     VerbFor(*first.difference, words), words.label, first.baseline, all, RangeOfChanges(judged, words),
                     VerdictName(first.verdict));
}

std::string SentenceOverConditions(const std::vector<Judged>& judged, const MetricWords& words) {
  const Comparison& first = *judged.front().comparison;
  const bool clear = first.verdict == Verdict::kBetter || first.verdict == Verdict::kWorse;
  if (clear && CountOf(judged, first.verdict) == static_cast<int>(judged.size())) {
    return ClearSentenceOverConditions(judged, words);
  }
  std::string counts;
  for (const Verdict verdict : {Verdict::kBetter, Verdict::kWorse, Verdict::kNoDifference, Verdict::kInconclusive}) {
    const int count = CountOf(judged, verdict);
    if (count == 0) continue;
    if (!counts.empty()) counts += ", ";
    counts += fmt::format("{} under {}", VerdictName(verdict),
                          count == static_cast<int>(judged.size()) ? fmt::format("all {} conditions", count)
                                                                   : fmt::format("{} of {}", count, judged.size()));
  }
  return fmt::format("“{}” compared with “{}” by {} is {}{}.", first.method, first.baseline, words.label, counts,
                     RangeOfChanges(judged, words));
}

// A method that fails in hard worlds must not look better for being judged on the easy ones alone.
std::string UnpairedWords(const std::vector<Judged>& judged) {
  int only_baseline = 0, only_method = 0;
  for (const Judged& j : judged) {
    only_baseline += j.comparison->only_baseline;
    only_method += j.comparison->only_method;
  }
  const Comparison& first = *judged.front().comparison;
  std::string text;
  const auto add = [&](const std::string& name, int worlds) {
    if (worlds > 0) text += fmt::format("{}only “{}” in {}", text.empty() ? "" : ", ", name, Plural(worlds, "world"));
  };
  add(first.baseline, only_baseline);
  add(first.method, only_method);
  return text.empty() ? "" : fmt::format(" Not in this difference, since one of the two has no value there: {}.", text);
}

}  // namespace

MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  const std::vector<Judged> judged = ComparisonsOf(scenario, method, metric);
  if (judged.empty()) {
    return {method, scenario.methods.front(), Verdict::kInconclusive,
            fmt::format("“{}” was not compared by {}.", method, words.label)};
  }
  const Verdict first = judged.front().comparison->verdict;
  const bool agree = CountOf(judged, first) == static_cast<int>(judged.size());
  const std::optional<Verdict> verdict = agree ? std::optional(first) : std::nullopt;
  const Comparison& comparison = *judged.front().comparison;
  const std::string sentence =
      judged.size() > 1 ? SentenceOverConditions(judged, words) : SentenceFor(comparison, words);
  return {method, comparison.baseline, verdict, sentence + UnpairedWords(judged)};
}

MethodFinding AnswerInWords(const ScenarioSummary& scenario, const std::string& metric) {
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (!IsComparedWithNone(scenario, scenario.methods[i]))
      return CompareInWords(scenario, scenario.methods[i], metric);
  }
  return {"", "", Verdict::kInconclusive, "Only one method ran, so there is nothing to compare it with."};
}

}  // namespace etude
