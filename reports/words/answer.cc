#include "reports/words/answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/words/figures.h"

namespace etude {
namespace {

std::string Amount(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + (words.is_share ? " pp" : words.difference_suffix);
}

std::string_view VerbFor(double difference, const MetricWords& words) {
  if (words.direction == Direction::kNeither) return "changes";
  return difference < 0 ? "lowers" : "raises";
}

std::string ClearSentence(const Comparison& c, const std::string& other, const MetricWords& words) {
  const double difference = *c.difference;
  const bool worse = c.verdict == Verdict::kWorse;
  const std::string worlds = fmt::format("{} of {}", FormatCount(worse ? c.worse : c.better), Plural(c.pairs, "world"));
  // The verb states the direction ("lowers by 12.3 (10.1–14.0)"), so the numbers have no sign: if the difference is
  // negative, the difference and its interval are negated.
  std::optional<double> low = c.ci_low, high = c.ci_high;
  if (difference < 0 && low && high) {
    low = -*c.ci_high;
    high = -*c.ci_low;
  }
  return fmt::format("“{}” {} the {} by {} (95 % CI {}) against {}; the difference matters in {}", c.method,
                     VerbFor(difference, words), words.label, Amount(std::abs(difference), words),
                     FormatInterval(low, high, words), other, worlds);
}

/// Returns true if the mean difference lies outside the interval of the median difference. The sentence then also
/// states the mean.
bool MeanTellsMore(const Comparison& c) {
  return c.mean && c.ci_low && c.ci_high && (*c.mean < *c.ci_low || *c.mean > *c.ci_high);
}

/// Returns the sentence about the comparison under one condition, without the part on sampling units and without the
/// full stop.
std::string SentenceFor(const Comparison& c, const std::string& other, const MetricWords& words) {
  if (c.pairs == 0 || !c.difference) {
    return fmt::format("“{}” could not be compared with {} by {}: no world has both values", c.method, other,
                       words.label);
  }
  if (!c.ci_low) {
    return fmt::format("“{}” and {} both have a value in {} only: too few to judge the {}", c.method, other,
                       Plural(c.pairs, "world"), words.label);
  }
  // Write the difference, and the mean difference if the mean lies outside the interval.
  std::string figures =
      fmt::format("{} (95 % CI {})", Amount(*c.difference, words), FormatInterval(c.ci_low, c.ci_high, words));
  if (c.verdict == Verdict::kUndecided && MeanTellsMore(c)) {
    figures = fmt::format("median {}, mean {} ({})", figures, Amount(*c.mean, words),
                          FormatInterval(c.mean_low, c.mean_high, words));
  }
  figures += fmt::format(" on {}", Plural(c.pairs, "world"));
  // Choose the verb that fits the verdict.
  switch (c.verdict) {
    case Verdict::kBetter:
    case Verdict::kWorse:
      return ClearSentence(c, other, words);
    case Verdict::kNoDifference:
      return fmt::format("“{}” makes no difference that matters to the {} against {}: {}", c.method, words.label, other,
                         figures);
    case Verdict::kUndecided:
      break;
  }
  return fmt::format("It is undecided whether “{}” changes the {} against {}: {}", c.method, words.label, other,
                     figures);
}

// Returns the smallest and the largest difference over conditions: ": 5.1° (95 % CI 4.0–6.2; noise=5) to 12.3°
// (10.0–14.1; noise=20), on 60 worlds each".
std::string RangeOfChanges(const std::vector<Judged>& judged, const MetricWords& words) {
  std::vector<Judged> known;
  std::ranges::copy_if(judged, std::back_inserter(known),
                       [](const Judged& j) { return j.comparison->difference.has_value(); });
  if (known.empty()) return "";
  const auto [smallest, largest] =
      std::ranges::minmax_element(known, {}, [](const Judged& j) { return std::abs(*j.comparison->difference); });
  const auto end = [&](const Judged& j, std::string_view what) {
    const Comparison& c = *j.comparison;
    const std::string interval =
        c.ci_low ? fmt::format("{}{}; ", what, FormatInterval(c.ci_low, c.ci_high, words)) : "";
    return fmt::format("{} ({}{})", Amount(*c.difference, words), interval, ConditionLabel(j.condition->condition));
  };
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
  if (verdict == Verdict::kBetter || verdict == Verdict::kWorse) {
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
             : fmt::format(" Not included in this difference, because one of the two has no value there: {}.", text);
}

// If one cost is at least this many times the other cost, the answer states the ratio of the costs instead of the
// difference.
constexpr double kMinTellingRatio = 2;
// A cost below this fraction of the practical threshold counts as zero, because a ratio with such a small denominator
// would be meaningless.
constexpr double kMinShareOfThreshold = 0.1;

std::optional<double> TypicalOf(const ConditionSummary& condition, const std::string& method, const std::string& metric,
                                const MetricWords& words) {
  const auto found = std::ranges::find(condition.methods, method, &MethodSummary::method);
  const MetricSummary* summary = found == condition.methods.end() ? nullptr : FindSummary(*found, metric);
  return summary == nullptr ? std::nullopt : TypicalValue(*summary, words);
}

std::string RatioText(const CostRatio& ratio) {
  const std::string least = FormatNumber(ratio.least), most = FormatNumber(ratio.most);
  return least == most ? least : fmt::format("{}–{}", least, most);
}

/// Returns true if this metric is the scenario's first headline metric, which its question is about. The answer then
/// compares success before it compares the metric.
bool IsAnswer(const ScenarioSummary& scenario, const std::string& metric) {
  return !scenario.headline_metrics.empty() && scenario.headline_metrics.front() == metric;
}

/// Returns the verb for a cost: a method "needs" steps, but "has" an error.
std::string_view VerbOf(const Comparison& c) {
  const MetricInfo* info = FindMetric(c.metric);
  return info != nullptr && info->unit.empty() && info->practical >= 1 ? "needs" : "has";
}

std::string CostPhrase(const std::vector<Judged>& judged, const CostRatio& ratio) {
  const Comparison& c = *judged.front().comparison;
  return fmt::format("{} {} × the {}", VerbOf(c), RatioText(ratio), WordsFor(c.metric).label);
}

std::string VerdictPhrase(const std::vector<Judged>& judged) {
  const std::string others = OthersOf(judged);
  const auto verdict = CommonVerdict(judged);
  if (!verdict)
    return fmt::format("against {} it depends: {}", others, CountVerdicts(VerdictsOf(judged), judged.size()));
  switch (*verdict) {
    case Verdict::kBetter:
      return "better than " + others;
    case Verdict::kWorse:
      return "worse than " + others;
    case Verdict::kNoDifference:
      return "no different from " + others;
    case Verdict::kUndecided:
      break;
  }
  return "undecided against " + others;
}

/// Returns the range of the differences from the other method over all conditions: " (−0.949 mm)"; "" if there are no
/// differences.
std::string ChangeOf(const std::vector<Judged>& judged, std::string_view what) {
  if (!HaveOneMetric(judged)) return "";
  std::optional<double> low, high;
  for (const Judged& j : judged) {
    const auto& difference = j.comparison->difference;
    if (!difference) continue;
    low = std::min(low.value_or(*difference), *difference);
    high = std::max(high.value_or(*difference), *difference);
  }
  if (!low) return "";
  const MetricWords words = WordsFor(judged.front().comparison->metric);
  const Comparison& first = *judged.front().comparison;
  if (judged.size() == 1 && first.verdict == Verdict::kUndecided && MeanTellsMore(first)) {
    return fmt::format(" ({}median {}, mean {})", what, FormatNumber(*low * words.scale), Amount(*first.mean, words));
  }
  const std::string range = *low == *high ? FormatNumber(*low * words.scale) : FormatInterval(low, high, words);
  return fmt::format(" ({}{}{}{})", what, *low > 0 ? "+" : "", range, words.is_share ? " pp" : words.difference_suffix);
}

std::string PhraseOf(const std::vector<Judged>& judged, std::string_view what = "") {
  const bool is_worse = CommonVerdict(judged) == Verdict::kWorse && HaveOneMetric(judged);
  const auto ratio = is_worse ? CostRatioOf(judged) : std::nullopt;
  return ratio ? fmt::format("{} of {}", CostPhrase(judged, *ratio), OthersOf(judged))
               : VerdictPhrase(judged) + ChangeOf(judged, what);
}

/// Considers the headline metrics other than `metric` in which `rival`, the strongest other method, is better. Returns,
/// in words, the largest ratio of costs among these metrics; "" if there is none.
std::string CostElsewhere(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                          const std::string& rival) {
  std::string phrase;
  double largest = 0;
  for (const std::string& other : scenario.headline_metrics) {
    const std::vector<Judged> judged = JudgedOf(scenario, method, other, Against::kRival);
    if (other == metric || judged.empty() || OthersOf(judged) != rival || CommonVerdict(judged) != Verdict::kWorse) {
      continue;
    }
    const auto ratio = CostRatioOf(judged);
    if (!ratio || ratio->most <= largest) continue;
    largest = ratio->most;
    phrase = CostPhrase(judged, *ratio);
  }
  return phrase;
}

std::string AgainstRival(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                         const std::string& baseline, const std::optional<Verdict>& of_baseline) {
  const std::vector<Judged> judged = AnswersOf(scenario, method, Against::kRival);
  if (judged.empty()) return "";
  // `metric` decided the comparison with the baseline. If another metric decided this comparison, name that metric.
  const std::string& decides = judged.front().comparison->metric;
  const std::string what = decides == metric ? "" : WordsFor(decides).label + " ";
  const std::string rival = OthersOf(judged);
  const std::string elsewhere = CostElsewhere(scenario, method, decides, rival);
  // If the baseline is also the strongest other method, the line has already stated this comparison.
  if (rival == baseline) return elsewhere.empty() ? ", the strongest other method" : ", but " + elsewhere;
  const auto verdict = CommonVerdict(judged);
  const bool twice_better = verdict == Verdict::kBetter && of_baseline == Verdict::kBetter;
  const std::string phrase = twice_better
                                 ? "also better than the strongest other method, " + rival + ChangeOf(judged, what)
                                 : PhraseOf(judged, what);
  const bool is_led = verdict == Verdict::kWorse;
  return "; " + (elsewhere.empty() ? phrase : is_led ? phrase + " and " + elsewhere : phrase + ", but " + elsewhere);
}

/// Returns the numbers from which the generalised verdict follows: the typical (pseudo-median) difference over sampling
/// units, and the interval of this difference: " Pseudo-median of 8 clips: 2.39 cm (−6.3 to 11.0).". Returns "" if
/// every world is its own unit, or if the difference or its interval is missing.
std::string MiddleOfUnits(const Comparison& c, const MetricWords& words, SamplingUnit unit) {
  if (WorldsAreUnits(unit) || !c.beyond.low || !c.beyond.difference) return "";
  return fmt::format(" Pseudo-median of {}: {} ({}).", CountUnits(c.beyond.units, unit),
                     Amount(*c.beyond.difference, words), FormatInterval(c.beyond.low, c.beyond.high, words));
}

/// Returns further facts behind an answer: the difference in the worlds where both methods succeeded and, if the far
/// better and far worse worlds (the tail) decide the answer, the numbers of these worlds.
std::string FurtherSteps(const Judged& judged) {
  const Answer* answer = judged.answer;
  if (answer == nullptr) return "";
  std::string text;
  if (const auto& both = answer->both_succeed; both && both->difference) {
    const MetricWords words = WordsFor(both->metric);
    const std::string interval =
        both->ci_low ? fmt::format(" ({})", FormatInterval(both->ci_low, both->ci_high, words)) : "";
    text = fmt::format(" Where both succeed ({}): {} {}{}.", Plural(both->pairs, "world"), words.label,
                       Amount(*both->difference, words), interval);
  }
  const bool open = answer->decided_by == AnswerStep::kNone && answer->verdict == Verdict::kUndecided;
  if (const auto& success = answer->success;
      open && success && success->difference && success->ci_low && success->verdict == Verdict::kUndecided) {
    const MetricWords words = WordsFor(success->metric);
    text += fmt::format(" It is undecided whether success differs: {} {} ({}).", words.label,
                        Amount(*success->difference, words), FormatInterval(success->ci_low, success->ci_high, words));
  }
  if (answer->decided_by == AnswerStep::kTail) {
    const Comparison& tail = *answer->tail;
    text += fmt::format(" The tail decides: far better in {}, far worse in {} of {}.", tail.better, tail.worse,
                        Plural(tail.pairs, "world"));
  }
  return text;
}

/// Returns a sentence that compares a method with another method over all conditions, with the numbers behind the
/// verdicts. `judged` must not be empty.
std::string SentenceOf(const std::vector<Judged>& judged, SamplingUnit unit) {
  const Comparison& first = *judged.front().comparison;
  const MetricWords words = WordsFor(first.metric);
  const bool swept = judged.size() > 1;
  std::string sentence = swept ? SentenceOverConditions(judged, words) : SentenceFor(first, OthersOf(judged), words);
  if (!WorldsAreUnits(unit) && first.beyond.units > 0) {
    sentence += fmt::format(" of {}", CountUnits(first.beyond.units, unit));
  }
  return fmt::format("{}.{}{}{}", sentence, swept ? "" : MiddleOfUnits(first, words, unit),
                     swept ? "" : FurtherSteps(judged.front()), UnpairedWords(judged));
}

}  // namespace

std::optional<CostRatio> CostRatioOf(const std::vector<Judged>& judged) {
  std::optional<CostRatio> range;
  for (const Judged& j : judged) {
    const Comparison& c = *j.comparison;
    const MetricInfo* info = FindMetric(c.metric);
    const MetricWords words = WordsFor(c.metric);
    if (info == nullptr || words.is_share || words.direction != Direction::kLowerIsBetter) return std::nullopt;
    const auto mine = TypicalOf(*j.condition, c.method, c.metric, words);
    for (const std::string& baseline : BaselinesOf(j)) {
      const auto theirs = TypicalOf(*j.condition, baseline, c.metric, words);
      if (!mine || !theirs || *theirs <= kMinShareOfThreshold * info->practical) return std::nullopt;
      const double ratio = *mine / *theirs;
      if (ratio < kMinTellingRatio) return std::nullopt;
      range = range ? CostRatio{std::min(range->least, ratio), std::max(range->most, ratio)} : CostRatio{ratio, ratio};
    }
  }
  return range;
}

std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric) {
  const bool is_answer = IsAnswer(scenario, metric);
  const std::vector<Judged> judged = is_answer ? AnswersOf(scenario, method, Against::kBaseline)
                                               : JudgedOf(scenario, method, metric, Against::kBaseline);
  if (judged.empty()) return "";
  const std::string& decides = judged.front().comparison->metric;
  const std::string what = WordsFor(decides).label + " ";
  std::string text = fmt::format("“{}”: {}{}", method, PhraseOf(judged, what),
                                 AgainstRival(scenario, method, decides, OthersOf(judged), CommonVerdict(judged)));
  if (BeyondInWords(judged, scenario.unit).on_these_only) text += fmt::format(", on {}", TheseUnits(scenario.unit));
  return text;
}

MethodFinding CompareInWords(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against) {
  const std::vector<Judged> judged =
      IsAnswer(scenario, metric) ? AnswersOf(scenario, method, against) : JudgedOf(scenario, method, metric, against);
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
          .sentence = SentenceOf(judged, scenario.unit),
          .why_open = judged.size() == 1 ? judged.front().comparison->why_open : ""};
}

std::string MethodInQuestion(const ScenarioSummary& scenario) {
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (!IsComparedWithNone(scenario, scenario.methods[i])) return scenario.methods[i];
  }
  return "";
}

}  // namespace etude
