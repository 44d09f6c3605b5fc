#include "reports/words/headline.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/words/beyond.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

// From here on a ratio says more than a difference.
constexpr double kTelling = 2;
// A value that is nearer to zero than this part of what matters is as good as none: a ratio to it says nothing.
constexpr double kLeastOfThreshold = 0.1;

std::optional<double> TypicalOf(const ConditionSummary& condition, const std::string& method,
                                const std::string& metric, const MetricWords& words) {
  const auto found = std::ranges::find(condition.methods, method, &MethodSummary::method);
  const MetricSummary* summary = found == condition.methods.end() ? nullptr : FindSummary(*found, metric);
  return summary == nullptr ? std::nullopt : TypicalValue(*summary, words);
}

std::string RatioText(const CostRatio& ratio) {
  const std::string least = FormatNumber(ratio.least), most = FormatNumber(ratio.most);
  return least == most ? least : fmt::format("{} to {}", least, most);
}

/// Steps and passes are needed, errors are had.
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
  if (!verdict) return fmt::format("against {} it depends: {}", others, CountVerdicts(VerdictsOf(judged), judged.size()));
  switch (*verdict) {
    case Verdict::kBetter:
      return "better than " + others;
    case Verdict::kWorse:
      return "worse than " + others;
    case Verdict::kNoDifference:
      return fmt::format("no different from {} in the {}", others, WordsFor(judged.front().comparison->metric).label);
    case Verdict::kInconclusive:
      break;
  }
  return "undecided against " + others;
}

std::string PhraseOf(const std::vector<Judged>& judged) {
  const auto ratio = CommonVerdict(judged) == Verdict::kWorse ? CostRatioOf(judged) : std::nullopt;
  return ratio ? fmt::format("{} of {}", CostPhrase(judged, *ratio), OthersOf(judged)) : VerdictPhrase(judged);
}

/// Where the rival's lead is not in the metric that the question is about, in another headline metric: the largest
/// ratio. "" without any.
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
  const std::vector<Judged> judged = JudgedOf(scenario, method, metric, Against::kRival);
  if (judged.empty()) return "";
  const std::string rival = OthersOf(judged);
  const std::string elsewhere = CostElsewhere(scenario, method, metric, rival);
  // Where the baseline is the strongest other one, the first half has said how it compares.
  if (rival == baseline) return elsewhere.empty() ? ", the strongest other method" : ", but " + elsewhere;
  const auto verdict = CommonVerdict(judged);
  const bool twice_better = verdict == Verdict::kBetter && of_baseline == Verdict::kBetter;
  const std::string phrase = twice_better ? "better than the strongest other one too, " + rival : PhraseOf(judged);
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
      if (!mine || !theirs || *theirs <= kLeastOfThreshold * info->practical) return std::nullopt;
      const double ratio = *mine / *theirs;
      if (ratio < kTelling) return std::nullopt;
      range = range ? CostRatio{std::min(range->least, ratio), std::max(range->most, ratio)} : CostRatio{ratio, ratio};
    }
  }
  return range;
}

std::string HeadlineOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric) {
  const std::vector<Judged> judged = JudgedOf(scenario, method, metric, Against::kBaseline);
  if (judged.empty()) return "";
  std::string text = fmt::format("“{}”: {}{}", method, PhraseOf(judged),
                                 AgainstRival(scenario, method, metric, OthersOf(judged), CommonVerdict(judged)));
  if (BeyondInWords(judged, scenario.unit).on_these_only) text += fmt::format(", on {}", TheseUnits(scenario.unit));
  return text;
}

}  // namespace etude
