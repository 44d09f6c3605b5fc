#include "bench/statistics/expectations.h"

#include <algorithm>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/paired_tests.h"
#include "bench/statistics/select.h"

namespace etude {
namespace {

bool Matches(const std::vector<SweptValue>& condition, const std::vector<SweptValue>& where) {
  return std::all_of(where.begin(), where.end(), [&](const SweptValue& wanted) {
    return std::any_of(condition.begin(), condition.end(),
                       [&](const SweptValue& swept) { return swept.key == wanted.key && swept.value == wanted.value; });
  });
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

struct Finding {
  Ruling ruling;
  std::string detail;
};

Finding JudgeComparison(const Expectation& expectation, const ConditionTable& table, const std::string& other,
                        bool wants_lower, std::uint64_t seed, const std::string& purpose) {
  MetricInfo metric = *FindMetric(expectation.metric);
  metric.direction = wants_lower ? Direction::kLowerIsBetter : Direction::kHigherIsBetter;
  const PairedWorlds worlds = PairsOf(table, other, expectation.of, expectation.metric);
  Comparison found = ComparePaired(worlds.pairs, metric, seed, purpose, expectation.confidence);
  std::optional<Comparison> with_failures;
  if (const auto all = WithFailures(worlds, metric)) {
    with_failures = ComparePaired(all->pairs, metric, seed, purpose + "/failures", expectation.confidence);
  }
  const Verdict of_pairs = JudgeBothWays(found, with_failures, metric, expectation.confidence);
  const int without = worlds.only_baseline + worlds.only_method + worlds.neither;
  const std::string missing = without == 0 ? "" : fmt::format(", {} more have no pair of values", without);
  if (!found.ci_low)
    return {Ruling::kUndecided, fmt::format("only {} worlds have both values{}", found.pairs, missing)};
  const Ruling ruling = found.verdict == Verdict::kBetter         ? Ruling::kMet
                        : found.verdict == Verdict::kInconclusive ? Ruling::kUndecided
                                                                  : Ruling::kUnmet;
  std::string detail = fmt::format("difference {:.4g} ({:.4g} % interval {:.4g} to {:.4g}, p = {:.2g}) on {} worlds{}",
                                   *found.difference, 100 * expectation.confidence, *found.ci_low, *found.ci_high,
                                   *found.p_holm, found.pairs, missing);
  if (found.verdict != of_pairs) return {ruling, detail + "; it does not hold when failing counts as losing"};
  const double alpha = 1 - expectation.confidence;
  if (ruling == Ruling::kUndecided && SmallestP(found.differing) > alpha) {
    detail += fmt::format("; {} of them differ, and {:.4g} % needs at least {}", found.differing,
                          100 * expectation.confidence, PairsNeeded(1, alpha));
  }
  return {ruling, detail};
}

Finding JudgeBound(const Expectation& expectation, const ConditionTable& table) {
  int missing = 0;
  const std::vector<double> values = table.Of(expectation.of).ValuesOf(expectation.metric, missing);
  if (values.empty()) return {Ruling::kUndecided, "no cell has a value"};
  const double value = expectation.statistic == "mean"  ? Mean(values)
                       : expectation.statistic == "p95" ? Quantile(values, 0.95)
                                                        : Quantile(values, 0.5);
  const bool met = expectation.at_most ? value <= *expectation.at_most : value >= *expectation.at_least;
  std::string detail = fmt::format("{:.4g} over {} worlds", value, values.size());
  if (missing > 0) detail += fmt::format(", {} more have no value", missing);
  if (met && missing > 0) return {Ruling::kUndecided, detail};
  return {met ? Ruling::kMet : Ruling::kUnmet, detail};
}

}  // namespace

ExpectationResult JudgeExpectation(const Expectation& expectation, const Study& study, const ScenarioTable& table,
                                   std::uint64_t seed) {
  ExpectationResult result{Claim(expectation), Ruling::kMet, ""};
  const bool wants_lower = !expectation.below.empty();
  const std::string& other = wants_lower ? expectation.below : expectation.above;
  for (const ConditionTable& condition : table.conditions()) {
    if (!Matches(condition.condition, expectation.where)) continue;
    const std::string purpose =
        PurposeOf(study.scenario, condition.condition, expectation.metric, other, expectation.of);
    const Finding finding = other.empty() ? JudgeBound(expectation, condition)
                                          : JudgeComparison(expectation, condition, other, wants_lower, seed, purpose);
    const std::string label = ConditionLabel(condition.condition);
    if (!result.detail.empty()) result.detail += "; ";
    result.detail += label.empty() ? finding.detail : label + ": " + finding.detail;
    // One condition that fails decides; else one that is undecided does.
    if (finding.ruling == Ruling::kUnmet) result.ruling = Ruling::kUnmet;
    if (finding.ruling == Ruling::kUndecided && result.ruling == Ruling::kMet) result.ruling = finding.ruling;
  }
  return result;
}

}  // namespace etude
