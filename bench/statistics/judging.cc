#include "bench/statistics/judging.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/statistics/answers.h"
#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/paired_tests.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns a note with the number of worlds in which a method has no value; "" if there are none. The difference leaves
/// such worlds out, which favours a method that fails in hard worlds (survivorship bias).
std::string NoteOnMissing(const Comparison& c) {
  const int without = c.only_baseline + c.only_method + c.neither;
  if (without == 0) return "";
  std::string who;
  const auto add = [&](const std::string& name, int worlds) {
    if (worlds > 0) who += fmt::format("{}{} in {}", who.empty() ? "" : ", ", name, worlds);
  };
  add(fmt::format("only “{}” has a value", c.baseline), c.only_baseline);
  add(fmt::format("only “{}” has a value", c.method), c.only_method);
  add("neither has one", c.neither);
  return fmt::format("the difference does not include {} of {} worlds: {}{}", without, c.pairs + without, who,
                     c.pairs > 0 && c.only_baseline + c.only_method > 0 ? " (survivorship bias)" : "");
}

/// Returns true if the numbers of worlds in which only one method has a value differ by more than chance (McNemar's
/// mid-p). Two methods are not equal if one of them loses values, even if their other values are equal.
bool LosesValues(const Comparison& c, double alpha = kAlpha) {
  return McNemarMidP(c.only_method, c.only_baseline) <= alpha;
}

std::string WhyValuesLost(const Comparison& c) {
  return fmt::format(
      "worlds with values of both methods show no difference, but only “{}” has a value in {} worlds, and only "
      "“{}” in {}",
      c.baseline, c.only_baseline, c.method, c.only_method);
}

std::string NotWithFailures(Verdict of_pairs) {
  return fmt::format("“{}” in worlds in which both have a value, but not if a failure counts as a loss",
                     VerdictName(of_pairs));
}

/// Returns the numbers of worlds in which the method is better and worse, as text. A median hides differences in fewer
/// than half of the worlds.
std::string DescribeWhatMedianHides(const Comparison& c) {
  const int tied = c.pairs - c.differing;
  const long better = std::lround(c.share_better * c.pairs - 0.5 * tied);  // `share_better` counts ties as half
  const std::string ties = 2 * tied > c.pairs ? "in most worlds the same, " : "";
  return fmt::format(
      "the median is too small to matter, but the mean may be large enough: {}in {} of {} better, in {} worse", ties,
      better, c.pairs, c.differing - better);
}

/// Returns a note if the mean difference exceeds the threshold and the median difference does not; otherwise "".
std::string NoteOnMean(const Comparison& c, const MetricInfo& metric) {
  if (metric.aggregate != Aggregate::kMedian || !c.mean_low) return "";
  const bool up = *c.mean_low > metric.practical, down = *c.mean_high < -metric.practical;
  if (!up && !down) return "";
  const bool agrees = up ? *c.difference > metric.practical : *c.difference < -metric.practical;
  if (agrees) return "";
  const auto amount = [&](double value) {
    const std::string text = fmt::format("{:.3g}", value);
    return text.starts_with('-') ? "−" + text.substr(1) : text;
  };
  const std::string unit = metric.unit.empty() ? "" : " " + metric.unit;
  return fmt::format("the mean differs by {}{} (95 % CI {} to {}), which the median does not show", amount(*c.mean),
                     unit, amount(*c.mean_low), amount(*c.mean_high));
}

/// Corrects the p-values of a family of comparisons: those without failures, and those with failures counted as losses.
/// Judges every comparison and adds its notes.
void JudgeOnTheseWorlds(std::span<Question* const> family, SamplingUnit unit) {
  // Apply Holm's correction to the p-values without failures, and to those with failures counted as losses.
  std::vector<std::optional<double>> pairs_alone, all_worlds;
  for (const Question* question : family) {
    const MetricInfo& metric = *FindMetric(question->comparison.metric);
    pairs_alone.push_back(DecidingP(question->comparison, metric));
    all_worlds.push_back(question->with_failures ? DecidingP(*question->with_failures, metric) : pairs_alone.back());
  }
  const auto corrected_alone = HolmCorrected(pairs_alone), corrected = HolmCorrected(all_worlds);
  // Judge each comparison, and state why its verdict is open.
  for (std::size_t i = 0; i < family.size(); ++i) {
    Comparison& comparison = family[i]->comparison;
    const MetricInfo& metric = *FindMetric(comparison.metric);
    comparison.p_holm = corrected_alone[i];
    if (family[i]->with_failures) family[i]->with_failures->p_holm = corrected[i];
    const Verdict of_pairs = JudgeBothWays(comparison, family[i]->with_failures, metric);
    if (comparison.verdict == of_pairs) {
      comparison.why_open = WhyOpen(comparison, metric, static_cast<int>(family.size()), unit);
    } else if (comparison.verdict == Verdict::kUndecided) {
      comparison.why_open = NotWithFailures(of_pairs);
    }
    if (comparison.verdict == Verdict::kNoDifference && LosesValues(comparison)) {
      comparison.verdict = Verdict::kUndecided;
      comparison.why_open = WhyValuesLost(comparison);
    }
    for (const std::string& note : {NoteOnMissing(comparison), NoteOnMean(comparison, metric)}) {
      if (!note.empty()) comparison.notes.push_back(note);
    }
  }
}

/// Copies the results for these worlds to `beyond`, for scenarios in which every world is its own unit.
void CopyVerdictsBeyond(Comparison& comparison) {
  Beyond& beyond = comparison.beyond;
  beyond.units = comparison.pairs;
  beyond.differing = comparison.differing;
  beyond.difference = comparison.difference;
  beyond.low = comparison.ci_low;
  beyond.high = comparison.ci_high;
  beyond.mean = comparison.mean;
  beyond.mean_low = comparison.mean_low;
  beyond.mean_high = comparison.mean_high;
  const MetricInfo& metric = *FindMetric(comparison.metric);
  beyond.test = metric.aggregate == Aggregate::kMedian ? comparison.signed_rank : comparison.sign_flip;
  beyond.p_holm = comparison.p_holm;
  if (comparison.pairs >= kMinSample) beyond.verdict = comparison.verdict;
  beyond.why_open = comparison.why_open;
}

/// Judges a family of comparisons as JudgeOnTheseWorlds does, but for units that were not run (Beyond).
void JudgeBeyond(std::span<Question* const> family, SamplingUnit unit) {
  // Apply Holm's correction to the p-values without failures, and to those with failures counted as losses.
  std::vector<std::optional<double>> pairs_alone, all_worlds;
  for (const Question* question : family) {
    pairs_alone.push_back(question->comparison.beyond.test.p);
    all_worlds.push_back(question->with_failures ? question->with_failures->beyond.test.p : pairs_alone.back());
  }
  const auto corrected_alone = HolmCorrected(pairs_alone), corrected = HolmCorrected(all_worlds);
  const int comparisons = static_cast<int>(family.size());
  for (std::size_t i = 0; i < family.size(); ++i) {
    Beyond& beyond = family[i]->comparison.beyond;
    const MetricInfo& metric = *FindMetric(family[i]->comparison.metric);
    // Judge without failures.
    beyond.p_holm = corrected_alone[i];
    beyond.verdict = VerdictBeyond(beyond, metric);
    beyond.why_open = WhyOpenBeyond(beyond, metric, unit, comparisons);
    if (beyond.verdict == Verdict::kNoDifference && LosesValues(family[i]->comparison)) {
      beyond.verdict = Verdict::kUndecided;
      beyond.why_open = WhyValuesLost(family[i]->comparison);
    }
    // Keep the verdict only if it is the same with failures counted.
    if (!family[i]->with_failures || !beyond.verdict) continue;
    Beyond& with_failures = family[i]->with_failures->beyond;
    with_failures.p_holm = beyond.p_holm = corrected[i];
    const Verdict of_pairs = *beyond.verdict;
    const auto with_their_p = VerdictBeyond(beyond, metric);
    if (with_their_p == of_pairs && VerdictBeyond(with_failures, metric) == of_pairs) continue;
    beyond.verdict = Verdict::kUndecided;
    if (of_pairs != Verdict::kUndecided) beyond.why_open = NotWithFailures(of_pairs);
  }
}

/// The swept values of a condition, split into those that Study::across names and the rest.
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

/// Returns true if `verdict` is about this comparison under the swept values `rest`.
bool IsSameQuestion(const AcrossVerdict& verdict, const std::vector<SweptValue>& rest, const Comparison& comparison) {
  return verdict.condition == rest && verdict.metric == comparison.metric && verdict.method == comparison.method &&
         verdict.baseline == comparison.baseline;
}

/// Returns true if the condition has all swept values in `where`.
bool Matches(const std::vector<SweptValue>& condition, const std::vector<SweptValue>& where) {
  return std::ranges::all_of(
      where, [&](const SweptValue& wanted) { return std::ranges::find(condition, wanted) != condition.end(); });
}

std::string Claim(const Expectation& expectation) {
  const MetricInfo& metric = *FindMetric(expectation.metric);
  std::string text = metric.label + " of " + expectation.of;
  if (!expectation.below.empty()) text += " below that of " + expectation.below;
  if (!expectation.above.empty()) text += " above that of " + expectation.above;
  const auto bound = [&](std::string_view words, double value) {
    const std::string unit = metric.unit.empty() ? "" : " " + metric.unit;
    return fmt::format("{} {} of {} {} {}{}", expectation.statistic, metric.label, expectation.of, words, value, unit);
  };
  if (expectation.at_most) text = bound("at most", *expectation.at_most);
  if (expectation.at_least) text = bound("at least", *expectation.at_least);
  if (!expectation.where.empty()) text += " where " + ConditionLabel(expectation.where);
  return text;
}

/// The result of one expectation under one condition, with the figures behind it.
struct Finding {
  ClaimOutcome outcome;
  std::string detail;
};

Finding JudgeComparison(const Expectation& expectation, const ConditionTable& table, const std::string& other,
                        bool wants_lower, std::uint64_t seed, const std::string& purpose) {
  // Compare the two methods in the worlds in which both have a value, and again with failures counted as losses.
  MetricInfo metric = *FindMetric(expectation.metric);
  metric.direction = wants_lower ? Direction::kLowerIsBetter : Direction::kHigherIsBetter;
  const PairedWorlds worlds = PairsOf(table, other, expectation.of, expectation.metric);
  Comparison found = ComparePaired(worlds.pairs, metric, seed, purpose, expectation.confidence);
  found.not_alike = worlds.not_alike;
  std::optional<Comparison> with_failures;
  if (const auto all = WithFailures(worlds, metric)) {
    with_failures = ComparePaired(all->pairs, metric, seed, purpose + "/failures", expectation.confidence);
    with_failures->not_alike = worlds.not_alike;
  }
  const Verdict of_pairs = JudgeBothWays(found, with_failures, metric, expectation.confidence);
  // As in JudgeFamily, two methods are not equal if one of them loses values.
  found.baseline = other;
  found.method = expectation.of;
  found.only_baseline = worlds.only_baseline;
  found.only_method = worlds.only_method;
  const double alpha = 1 - expectation.confidence;
  const bool is_open = found.verdict == Verdict::kNoDifference && LosesValues(found, alpha);
  // Decide from the verdict whether the expectation is met, unmet or undecided.
  const int without = worlds.only_baseline + worlds.only_method + worlds.neither;
  const std::string missing = without == 0 ? "" : fmt::format(", in {} more a method has no value", without);
  if (!found.ci_low)
    return {ClaimOutcome::kUndecided,
            fmt::format("only {} worlds have values of both methods{}", found.pairs, missing)};
  const ClaimOutcome outcome = found.verdict == Verdict::kBetter                 ? ClaimOutcome::kMet
                               : is_open || found.verdict == Verdict::kUndecided ? ClaimOutcome::kUndecided
                                                                                 : ClaimOutcome::kUnmet;
  // Describe the figures that decided the outcome.
  const std::string unit = metric.unit.empty() ? "" : " " + metric.unit;
  std::string detail = fmt::format(
      "difference {:.4g}{} ({:.4g} % interval {:.4g} to {:.4g}, p = {:.2g}) on {} worlds{}", *found.difference, unit,
      100 * expectation.confidence, *found.ci_low, *found.ci_high, *found.p_holm, found.pairs, missing);
  if (!found.not_alike.empty()) return {outcome, detail + "; " + found.not_alike};
  if (found.verdict != of_pairs) return {outcome, detail + "; it does not hold if a failure counts as a loss"};
  if (is_open) return {outcome, detail + "; " + WhyValuesLost(found)};
  if (outcome == ClaimOutcome::kUndecided && SmallestP(found.differing) > alpha) {
    detail += fmt::format("; {} of these worlds differ, and a confidence of {:.4g} % needs at least {} that differ",
                          found.differing,
                          100 * expectation.confidence, PairsNeeded(1, alpha));
  }
  return {outcome, detail};
}

/// Changes "met" to "unmet" if a method that is expected to be better in the value metric (`ValueMetricOf`) has the
/// worse success, because answers compare success before the value metric.
void AskSuccessFirst(const Expectation& expectation, const Study& study, const ConditionTable& table,
                     const std::string& other, bool wants_lower, std::uint64_t seed, Finding& finding) {
  const bool wants_better = wants_lower == (FindMetric(expectation.metric)->direction == Direction::kLowerIsBetter);
  if (finding.outcome != ClaimOutcome::kMet || !wants_better || expectation.metric != ValueMetricOf(study)) return;
  const auto success = CompareSuccess(study, table, expectation.of, other, seed);
  if (!success || success->verdict != Verdict::kWorse) return;
  finding.outcome = ClaimOutcome::kUnmet;
  finding.detail += fmt::format("; but its success ({}) is worse by {:.4g}", FindMetric(study.success)->label,
                                std::abs(*success->difference));
}

Finding JudgeBound(const Expectation& expectation, const ConditionTable& table) {
  int missing = 0;
  const std::vector<double> values = table.Of(expectation.of).ValuesOf(expectation.metric, missing);
  if (values.empty()) return {ClaimOutcome::kUndecided, "no cell has a value"};
  const double value = expectation.statistic == "mean"  ? Mean(values)
                       : expectation.statistic == "p95" ? Quantile(values, 0.95)
                                                        : Quantile(values, 0.5);
  const bool met = expectation.at_most ? value <= *expectation.at_most : value >= *expectation.at_least;
  const std::string& unit = FindMetric(expectation.metric)->unit;
  std::string detail = fmt::format("{:.4g}{}{} over {} worlds", value, unit.empty() ? "" : " ", unit, values.size());
  if (missing > 0) detail += fmt::format(", {} more have no value", missing);
  if (met && missing > 0) return {ClaimOutcome::kUndecided, detail};
  return {met ? ClaimOutcome::kMet : ClaimOutcome::kUnmet, detail};
}

}  // namespace

std::string WhyOpen(const Comparison& c, const MetricInfo& metric, int comparisons, SamplingUnit unit) {
  if (c.verdict != Verdict::kUndecided) return "";
  const std::string_view worlds = unit == SamplingUnit::kPerson ? "people" : "worlds";
  if (c.pairs == 0) return "no world has values of both methods";
  if (!c.not_alike.empty()) return c.not_alike;
  // McNemar's mid-p of n differing pairs is at least 1 / 2ⁿ, half of the smallest p of the other tests.
  const double sharper = c.sign_flip.how == kMidP ? 2 : 1;
  const int needed = PairsNeeded(comparisons, sharper * kAlpha);
  // The interval lies within ± threshold, but relevant differences may exist that the interval cannot show.
  const bool within = c.ci_low && *c.ci_low >= -metric.practical && *c.ci_high <= metric.practical;
  if (within && SeesTooFewDiffer(c, metric)) {
    return fmt::format(
        "only {} of {} pairs differ; rare differences that would change the mean may be missing among them",
        c.differing, c.pairs);
  }
  if (within && metric.aggregate == Aggregate::kMedian) return DescribeWhatMedianHides(c);
  if (c.differing == 0 && c.ci_low) {
    return fmt::format("no pair differs, but {} {} are too few to exclude a difference that matters", c.pairs, worlds);
  }
  // There are too few worlds for the test or the interval.
  if (*c.p_holm > kAlpha && c.differing < needed) {
    return fmt::format("too few {}: {} of {} pairs differ, so p ≥ {:.2g}; {} needs at least {}", worlds, c.differing,
                       c.pairs, SmallestP(c.differing) / sharper,
                       comparisons == 1 ? "one comparison" : fmt::format("one of {} comparisons (Holm)", comparisons),
                       needed);
  }
  if (!c.ci_low) return fmt::format("too few {}: fewer than {} pairs give no interval", worlds, kMinSample);
  // The interval and the test disagree.
  const bool beyond_zero = *c.ci_low > 0 || *c.ci_high < 0;
  if (!beyond_zero && *c.p_holm > kAlpha) return "the interval contains zero and differences that matter";
  if (!beyond_zero) {
    return fmt::format("the test finds a difference (p = {:.2g} among {}), but the interval of its {} reaches zero",
                       *c.p_holm, comparisons, metric.aggregate == Aggregate::kMedian ? "median" : "mean");
  }
  const double p = *DecidingP(c, metric);
  if (*c.p_holm > kAlpha) {
    if (p > kAlpha) return fmt::format("the interval excludes zero, but the test does not confirm it (p = {:.2g})", p);
    return fmt::format("p = {:.2g} is significant alone, but not among {} comparisons (Holm)", p, comparisons);
  }
  // The interval and the test both find a difference, but it is too small, or the metric has no direction.
  if (std::abs(*c.difference) < metric.practical)
    return "there is a difference, but it is undecided whether it is large enough to matter";
  return "there is a difference, but neither direction is better";
}

std::vector<std::optional<double>> HolmCorrected(std::span<const std::optional<double>> p_values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (p_values[i]) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return *p_values[a] != *p_values[b] ? *p_values[a] < *p_values[b] : a < b;
  });
  std::vector<std::optional<double>> corrected(p_values.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double factor = static_cast<double>(p_values.size() - rank);
    largest = std::max(largest, std::min(1.0, factor * *p_values[order[rank]]));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

void JudgeFamily(std::span<Question* const> family, SamplingUnit unit) {
  JudgeOnTheseWorlds(family, unit);
  if (!WorldsAreUnits(unit)) return JudgeBeyond(family, unit);
  for (Question* question : family) CopyVerdictsBeyond(question->comparison);
}

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
      if (found->verdict != comparison.verdict) found->verdict = Verdict::kUndecided;
    }
  }
  return verdicts;
}

ExpectationResult JudgeExpectation(const Expectation& expectation, const Study& study, const ScenarioTable& table,
                                   std::uint64_t seed) {
  ExpectationResult result{Claim(expectation), ClaimOutcome::kMet, ""};
  const bool wants_lower = !expectation.below.empty();
  const std::string& other = wants_lower ? expectation.below : expectation.above;
  for (const ConditionTable& condition : table.conditions()) {
    if (!Matches(condition.condition, expectation.where)) continue;
    const std::string purpose = PurposeOf(study.scenario, condition.condition, expectation.metric);
    Finding finding = other.empty() ? JudgeBound(expectation, condition)
                                    : JudgeComparison(expectation, condition, other, wants_lower, seed, purpose);
    if (!other.empty()) AskSuccessFirst(expectation, study, condition, other, wants_lower, seed, finding);
    const std::string label = ConditionLabel(condition.condition);
    if (!result.detail.empty()) result.detail += "; ";
    result.detail += label.empty() ? finding.detail : label + ": " + finding.detail;
    // One unmet condition makes the expectation unmet. Otherwise, one undecided condition makes it undecided.
    if (finding.outcome == ClaimOutcome::kUnmet) result.outcome = ClaimOutcome::kUnmet;
    if (finding.outcome == ClaimOutcome::kUndecided && result.outcome == ClaimOutcome::kMet)
      result.outcome = finding.outcome;
  }
  return result;
}

}  // namespace etude
