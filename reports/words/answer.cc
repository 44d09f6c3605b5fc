#include "reports/words/answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/words/figures.h"

namespace etude {
namespace {

std::string_view VerbFor(double difference, const MetricWords& words) {
  if (words.direction == Direction::kNeither) return "changes";
  return difference < 0 ? "lowers" : "raises";
}

std::string ClearSentence(const Comparison& c, bool worse, const std::string& other, const MetricWords& words) {
  const double difference = *c.difference;
  const std::string worlds = fmt::format("{} of {}", FormatCount(worse ? c.worse : c.better), Plural(c.pairs, "world"));
  // The verb states the direction ("lowers by 12.3 (10.1–14.0)"), so the numbers have no sign: if the difference is
  // negative, the difference and its interval are negated.
  std::optional<double> low = c.ci_low, high = c.ci_high;
  if (difference < 0 && low && high) {
    low = -*c.ci_high;
    high = -*c.ci_low;
  }
  return fmt::format("“{}” {} the {} by {} (95 % CI {}) against {}; the difference matters in {}", c.method,
                     VerbFor(difference, words), words.label, ShortDifference(std::abs(difference), words),
                     FormatInterval(low, high, words), other, worlds);
}

/// Returns the sentence about the comparison under one condition, without the part on sampling units and without the
/// full stop.
std::string SentenceFor(const Judged& judged, const std::string& other, const MetricWords& words) {
  const Comparison& c = *judged.comparison;
  const Verdict verdict = judged.Here();
  if (c.pairs == 0 || !c.difference) {
    return fmt::format("“{}” could not be compared with {} by {}, because no world has values of both methods",
                       c.method, other, words.label);
  }
  if (!c.ci_low) {
    return fmt::format("“{}” and {} both have a value in only {}, which is too few to judge the {}", c.method, other,
                       Plural(c.pairs, "world"), words.label);
  }
  // Write the difference. Also write the mean difference if it lies outside the interval and the verdict is undecided
  // or decided by the tail.
  std::string figures =
      fmt::format("{} (95 % CI {})", ShortDifference(*c.difference, words), FormatInterval(c.ci_low, c.ci_high, words));
  const bool by_tail = IsDecidedByTail(judged);
  if ((by_tail || verdict == Verdict::kUndecided) && MeanTellsMore(c)) {
    figures = fmt::format("median {}, mean {} ({})", figures, ShortDifference(*c.mean, words),
                          FormatInterval(c.mean_low, c.mean_high, words));
  }
  figures += fmt::format(" on {}", Plural(c.pairs, "world"));
  if (by_tail) {
    return fmt::format("“{}” is {} than {}: {}; {}, {}", c.method, VerdictName(verdict), other,
                       TailInWords(*judged.answer), words.label, figures);
  }
  // Choose the verb that fits the verdict. If the value has a verdict and the answer has none, say first that the
  // answer is undecided.
  const bool is_open = verdict == Verdict::kUndecided && c.verdict != Verdict::kUndecided;
  const std::string begin = is_open ? "Undecided: " : "";
  switch (is_open ? c.verdict : verdict) {
    case Verdict::kBetter:
    case Verdict::kWorse:
      return begin + ClearSentence(c, (is_open ? c.verdict : verdict) == Verdict::kWorse, other, words);
    case Verdict::kNoDifference:
      return fmt::format("{}“{}” makes no difference that matters to the {} against {}: {}", begin, c.method,
                         words.label, other, figures);
    case Verdict::kUndecided:
      break;
  }
  return fmt::format("It is undecided whether “{}” changes the {} against {}: {}", c.method, words.label, other,
                     figures);
}

// Returns the smallest and the largest difference over conditions: ": 5.1° (95 % CI 4.0–6.2; noise=5) to 12.3°
// (10.0–14.1; noise=20), on 60 worlds each". If no difference is above 0, the smallest one is the one nearest 0.
std::string RangeOfChanges(const std::vector<Judged>& judged, const MetricWords& words) {
  std::vector<Judged> known;
  std::ranges::copy_if(judged, std::back_inserter(known),
                       [](const Judged& j) { return j.comparison->difference.has_value(); });
  if (known.empty()) return "";
  const bool falls = std::ranges::all_of(known, [](const Judged& j) { return *j.comparison->difference <= 0; });
  const auto [smallest, largest] = std::ranges::minmax_element(
      known, {}, [&](const Judged& j) { return (falls ? -1 : 1) * *j.comparison->difference; });
  const auto end = [&](const Judged& j, std::string_view what) {
    const Comparison& c = *j.comparison;
    const std::string interval =
        c.ci_low ? fmt::format("{}{}; ", what, FormatInterval(c.ci_low, c.ci_high, words)) : "";
    return fmt::format("{} ({}{})", ShortDifference(*c.difference, words), interval,
                       ConditionLabel(j.condition->condition));
  };
  if (known.size() == 1) {
    const Comparison& c = *known.front().comparison;
    return fmt::format(": {}{} on {}", ShortDifference(*c.difference, words),
                       c.ci_low ? fmt::format(" (95 % CI {})", FormatInterval(c.ci_low, c.ci_high, words)) : "",
                       Plural(c.pairs, "world"));
  }
  const auto [fewest, most] = std::ranges::minmax(known, {}, [](const Judged& j) { return j.comparison->pairs; });
  const int few = fewest.comparison->pairs, many = most.comparison->pairs;
  return fmt::format(": {} to {}, on {} each", end(*smallest, "95 % CI "), end(*largest, ""),
                     few == many ? Plural(many, "world") : fmt::format("{} to {}", few, Plural(many, "world")));
}

std::string SentenceOverConditions(const std::vector<Judged>& judged, const MetricWords& words) {
  const Comparison& first = *judged.front().comparison;
  if (!HaveOneMetric(judged)) {
    return fmt::format("“{}” against {} is {}", first.method, OthersOf(judged),
                       CountVerdicts(VerdictsOf(judged), judged.size()));
  }
  const std::string others = OthersOf(judged), range = RangeOfChanges(judged, words);
  // With two conditions, the range of differences has already named both conditions.
  const std::string under = judged.size() > 2 ? " under " + AllConditions(judged.size()) : "";
  const auto verdict = CommonVerdict(judged);
  const bool by_tail = std::ranges::any_of(judged, IsDecidedByTail);
  if (!by_tail && (verdict == Verdict::kBetter || verdict == Verdict::kWorse)) {
    return fmt::format("“{}” {} the {} against {}{}{}", first.method, VerbFor(*first.difference, words), words.label,
                       others, under, range);
  }
  if (verdict == Verdict::kNoDifference) {
    return fmt::format("“{}” makes no difference that matters to the {} against {}{}{}", first.method, words.label,
                       others, under, range);
  }
  if (verdict == Verdict::kUndecided) {
    return fmt::format("It is undecided whether “{}” changes the {} against {}{}{}", first.method, words.label, others,
                       under, range);
  }
  return fmt::format("“{}” against {} by {} is {}{}", first.method, others, words.label,
                     CountVerdicts(VerdictsOf(judged), judged.size()), range);
}

// Returns a sentence with the number of worlds in which only one method has a value. If these worlds were not
// mentioned, a method that fails in hard worlds would look better.
std::string UnpairedWords(const std::vector<Judged>& judged) {
  int only_baseline = 0, only_method = 0;
  for (const Judged& j : judged) {
    only_baseline += j.comparison->only_baseline;
    only_method += j.comparison->only_method;
  }
  const Comparison& first = *judged.front().comparison;
  std::string text;
  const auto add = [&](const std::string& name, int worlds) {
    if (worlds > 0) text += fmt::format("{}only {} in {}", text.empty() ? "" : ", ", name, Plural(worlds, "world"));
  };
  add(OthersOf(judged), only_baseline);
  add(fmt::format("“{}”", first.method), only_method);
  return text.empty()
             ? ""
             : fmt::format(" The difference does not include worlds in which only one method has a value: {}.", text);
}

/// Returns the numbers from which the generalised verdict follows: the typical (pseudo-median) difference over sampling
/// units, and the interval of this difference; and the reason if there is no such verdict or if it is undecided:
/// " Pseudo-median of 8 clips: 2.39 cm (−6.3 to 11.0). For other clips: …". Returns "" if every world is its own unit.
std::string MiddleOfUnits(const Judged& judged, const MetricWords& words, SamplingUnit unit) {
  if (WorldsAreUnits(unit)) return "";
  const Beyond& beyond = judged.comparison->beyond;
  std::string text;
  if (beyond.low && beyond.difference) {
    text = fmt::format(" Pseudo-median of {}: {} ({}).", CountUnits(beyond.units, unit),
                       ShortDifference(*beyond.difference, words), FormatInterval(beyond.low, beyond.high, words));
  }
  const std::string& why = IsDecidedByTail(judged) ? judged.answer->tail->beyond.why_open : beyond.why_open;
  const bool is_open = judged.Elsewhere().value_or(Verdict::kUndecided) == Verdict::kUndecided;
  return is_open && !why.empty() ? text + fmt::format(" For {}: {}.", OtherUnits(unit), why) : text;
}

/// Returns true if the comparison is by the success metric of its answer.
bool IsOfSuccess(const Judged& judged) {
  const Answer* answer = judged.answer;
  return answer != nullptr && answer->success && answer->success->metric == judged.comparison->metric;
}

/// Returns why an undecided comparison is undecided: " Why: …."; else "".
std::string WhyUndecided(const Judged& judged) {
  const std::string& why = IsOfSuccess(judged) ? judged.answer->success->why_open : judged.comparison->why_open;
  return judged.Here() == Verdict::kUndecided && !why.empty() ? fmt::format(" Why: {}.", why) : "";
}

/// Returns further facts behind an answer under one condition: the difference in the worlds where both methods
/// succeeded, and the difference in success if the answer is undecided because success is.
std::string FurtherSteps(const Judged& judged) {
  const Answer* answer = judged.answer;
  if (answer == nullptr) return "";
  std::string text;
  if (const auto& both = answer->both_succeed; both && both->difference) {
    const MetricWords words = WordsFor(both->metric);
    const std::string interval =
        both->ci_low ? fmt::format(" ({})", FormatInterval(both->ci_low, both->ci_high, words)) : "";
    text += fmt::format(" Where both succeed ({}): {} {}{}.", Plural(both->pairs, "world"), words.label,
                        ShortDifference(*both->difference, words), interval);
  }
  // If both methods have the same success in every world, success is not the reason why the answer is undecided.
  if (const auto& success = answer->success; success && !IsOfSuccess(judged) && success->ci_low &&
                                             success->differing > 0 && success->verdict == Verdict::kUndecided &&
                                             judged.Here() == Verdict::kUndecided) {
    const MetricWords words = WordsFor(success->metric);
    text += fmt::format(" It is undecided whether success differs: {} {} ({}){}{}.", words.label,
                        ShortDifference(*success->difference, words),
                        FormatInterval(success->ci_low, success->ci_high, words), success->why_open.empty() ? "" : "; ",
                        success->why_open);
  }
  return text;
}

/// Returns a sentence that compares a method with another method over all conditions, with the numbers behind the
/// verdicts. `judged` must not be empty.
std::string SentenceOf(const std::vector<Judged>& judged, const std::vector<Judged>& values, SamplingUnit unit) {
  const Comparison& first = *judged.front().comparison;
  const MetricWords words = WordsFor(first.metric);
  const bool swept = judged.size() > 1;
  std::string sentence =
      swept ? SentenceOverConditions(judged, words) : SentenceFor(judged.front(), OthersOf(judged), words);
  if (!WorldsAreUnits(unit) && first.beyond.units > 0) {
    sentence += fmt::format(" of {}", CountUnits(first.beyond.units, unit));
  }
  const MetricWords of_value = values.empty() ? words : WordsFor(values.front().comparison->metric);
  const std::string range = RangeOfChanges(values, of_value);
  sentence += '.';
  if (!swept) sentence += WhyUndecided(judged.front()) + MiddleOfUnits(judged.front(), words, unit);
  return fmt::format("{}{}{}{}", sentence,
                     range.empty() ? "" : fmt::format(" Difference in {}{}.", of_value.label, range),
                     swept ? "" : FurtherSteps(judged.front()), UnpairedWords(judged));
}

}  // namespace

MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against) {
  const std::vector<Judged> judged = QuestionOf(scenario, method, metric, against);
  if (judged.empty()) {
    MethodFinding finding{.method = method, .baseline = scenario.methods.front(), .unit = scenario.unit};
    finding.verdict = Verdict::kUndecided;
    finding.sentence = fmt::format("“{}” was not compared by {}.", method, WordsFor(metric).label);
    return finding;
  }
  return {.method = method,
          .baseline = judged.front().comparison->baseline,
          .unit = scenario.unit,
          .is_compared = true,
          .verdict = CommonVerdict(judged),
          .beyond = BeyondInWords(judged, scenario.unit),
          .others = OthersOf(judged),
          .sentence = SentenceOf(judged, ValuesBeside(scenario, judged, against), scenario.unit)};
}

std::string MethodInQuestion(const ScenarioSummary& scenario) {
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (!IsComparedWithNone(scenario, scenario.methods[i])) return scenario.methods[i];
  }
  return "";
}

}  // namespace etude
