#include <fmt/core.h>

#include <algorithm>

#include "reports/words/answer.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

// If the cost of a method that is worse is at least this many times the other method's cost, the answer states the
// ratio of the costs instead of the difference.
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

/// Returns the verb for a cost: a method "needs" steps, but "has" an error.
std::string_view VerbOf(const Comparison& c) {
  const MetricInfo* info = FindMetric(c.metric);
  return info != nullptr && info->unit.empty() && info->practical >= 1 ? "needs" : "has";
}

std::string CostPhrase(const std::vector<Judged>& judged, const CostRatio& ratio) {
  const Comparison& c = *judged.front().comparison;
  return fmt::format("{} {} × the {}", VerbOf(c), RatioText(ratio), WordsFor(c.metric).label);
}

/// Returns " on these clips" (or people, …: the words for `unit`) if the verdict is claimed only for the units of this
/// run. Returns "" if other units have the same verdict, or if the verdict is undecided.
std::string OnTheseOnly(const std::vector<Judged>& judged, SamplingUnit unit) {
  if (CommonVerdict(judged) == Verdict::kUndecided || BeyondInWords(judged, unit).as_on_these) return "";
  return fmt::format(" on {}", TheseUnits(unit));
}

std::string VerdictPhrase(const std::vector<Judged>& judged) {
  const std::string others = OthersOf(judged);
  const auto verdict = CommonVerdict(judged);
  if (!verdict)
    return fmt::format("compared with {}, the verdict depends on the condition: {}", others,
                       CountVerdicts(VerdictsOf(judged), judged.size()));
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

/// Returns `what` and the range of the differences from the other method over all conditions: "−0.949 mm" if all are
/// equal. For one condition, the text may state the tail instead, or the mean as well. Returns "" if there are no
/// differences, or if the comparisons have different metrics.
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
  if (judged.size() == 1 && IsDecidedByTail(judged.front())) {
    return fmt::format("{}{}", what, TailInWords(*judged.front().answer));
  }
  if (judged.size() == 1 && first.verdict == Verdict::kUndecided && MeanTellsMore(first)) {
    return fmt::format("{}median {}, mean {}", what, FormatNumber(*low * words.scale),
                       ShortDifference(*first.mean, words));
  }
  const std::string range = *low == *high ? FormatNumber(*low * words.scale) : FormatInterval(low, high, words);
  return fmt::format("{}{}{}{}", what, *low > 0 ? "+" : "", range, words.is_share ? " pp" : words.difference_suffix);
}

/// Returns `text` in brackets, after a space; "" for "".
std::string Bracketed(const std::string& text) { return text.empty() ? "" : fmt::format(" ({})", text); }

std::string PhraseOf(const std::vector<Judged>& judged, const std::string& change, SamplingUnit unit) {
  const bool is_worse = CommonVerdict(judged) == Verdict::kWorse && HaveOneMetric(judged);
  const auto ratio = is_worse ? CostRatioOf(judged) : std::nullopt;
  const std::string where = OnTheseOnly(judged, unit);
  return ratio ? fmt::format("{} of {}{}", CostPhrase(judged, *ratio), OthersOf(judged), where)
               : VerdictPhrase(judged) + where + Bracketed(change);
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
  // `metric` decided the comparison with the baseline. If another metric decided the comparison with the
  // rival, name that metric.
  const std::string& decides = judged.front().comparison->metric;
  const std::string what = decides == metric ? "" : WordsFor(decides).label + " ";
  const std::string rival = OthersOf(judged);
  const std::string elsewhere = CostElsewhere(scenario, method, decides, rival);
  // If the baseline is also the strongest other method, the line has already stated this comparison.
  if (rival == baseline) return elsewhere.empty() ? ", the strongest other method" : ", but " + elsewhere;
  const auto verdict = CommonVerdict(judged);
  const bool twice_better = verdict == Verdict::kBetter && of_baseline == Verdict::kBetter;
  const std::string change = ChangeOf(judged, what);
  const std::string phrase = twice_better ? fmt::format("also better than the strongest other method, {}{}{}", rival,
                                                        OnTheseOnly(judged, scenario.unit), Bracketed(change))
                                          : PhraseOf(judged, change, scenario.unit);
  const bool is_led = verdict == Verdict::kWorse;
  return "; " + (elsewhere.empty() ? phrase : is_led ? phrase + " and " + elsewhere : phrase + ", but " + elsewhere);
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
  const std::vector<Judged> judged = QuestionOf(scenario, method, metric, Against::kBaseline);
  if (judged.empty()) return "";
  const std::string& decides = judged.front().comparison->metric;
  std::string change = ChangeOf(judged, WordsFor(decides).label + " ");
  if (const std::vector<Judged> values = ValuesBeside(scenario, judged, Against::kBaseline); !values.empty()) {
    const std::string of_value = ChangeOf(values, WordsFor(values.front().comparison->metric).label + " ");
    if (!change.empty() && !of_value.empty()) change += ", " + of_value;
  }
  return fmt::format("“{}”: {}{}", method, PhraseOf(judged, change, scenario.unit),
                     AgainstRival(scenario, method, decides, OthersOf(judged), CommonVerdict(judged)));
}

}  // namespace etude
