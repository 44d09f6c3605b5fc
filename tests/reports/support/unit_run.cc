#include "tests/reports/support/unit_run.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

constexpr int kClipsNeeded = 6;

double TypicalOf(const MethodSummary& method, const std::string& metric) {
  return *TypicalValue(*FindSummary(method, metric), WordsFor(metric));
}

const MethodSummary& StrongestOther(const ConditionSummary& condition, const std::string& method,
                                    const std::string& metric) {
  const double sign = WordsFor(metric).direction == Direction::kHigherIsBetter ? -1 : 1;
  const MethodSummary* best = nullptr;
  for (const MethodSummary& other : condition.methods) {
    if (other.method == method) continue;
    if (best == nullptr || sign * TypicalOf(other, metric) < sign * TypicalOf(*best, metric)) best = &other;
  }
  return *best;
}

void AddBeyond(Comparison& c, SamplingUnit unit, int clips) {
  Beyond& beyond = c.beyond;
  beyond.difference = beyond.mean = c.mean;
  beyond.low = *c.mean_low - 1;
  beyond.high = *c.mean_high + 1;
  if (WorldsAreUnits(unit)) {
    beyond.units = c.pairs;
    beyond.verdict = c.verdict;
    return;
  }
  beyond.units = clips;
  for (int i = 0; i < clips; ++i) {
    beyond.left_out.push_back({fmt::format("clip-{}", i), *c.mean * (i == 2 ? 0.5 : 1 + 0.02 * i)});
  }
  if (clips < kClipsNeeded) {
    beyond.why_open = fmt::format("{} clips, {} are needed", clips, kClipsNeeded);
    return;
  }
  beyond.verdict = c.verdict;
}

void AddRivals(const ScenarioSummary& scenario, ConditionSummary& condition, int clips) {
  for (const std::string& metric : scenario.headline_metrics) {
    for (const MethodSummary& method : condition.methods) {
      const MethodSummary& rival = StrongestOther(condition, method.method, scenario.headline_metrics.front());
      const double difference = TypicalOf(method, metric) - TypicalOf(rival, metric);
      Comparison c = condition.comparisons.front();
      c.metric = metric;
      c.method = method.method;
      c.baseline = rival.method;
      c.difference = c.mean = difference;
      c.ci_low = c.mean_low = difference - 0.5;
      c.ci_high = c.mean_high = difference + 0.5;
      c.verdict = (difference < 0) == (WordsFor(metric).direction == Direction::kLowerIsBetter) ? Verdict::kBetter
                                                                                               : Verdict::kWorse;
      c.beyond = {};
      AddBeyond(c, scenario.unit, clips);
      condition.rivals.push_back(std::move(c));
    }
  }
}

}  // namespace

void AddUnits(RunData& run, ScenarioSummary& scenario, int clips) {
  for (ConditionSummary& condition : scenario.conditions) {
    for (Comparison& c : condition.comparisons) AddBeyond(c, scenario.unit, clips);
    if (condition.methods.size() > 1) AddRivals(scenario, condition, clips);
  }
  for (Row& row : run.rows) {
    if (row.scenario != scenario.name || WorldsAreUnits(scenario.unit)) continue;
    row.units = {fmt::format("clip-{}", row.trial % clips)};
    if (scenario.unit == SamplingUnit::kClipPair) row.units.push_back(fmt::format("clip-{}", (row.trial + 1) % clips));
  }
}

RunData UnitRun() {
  RunData run = ExampleRun();
  for (ScenarioSummary& scenario : run.scenarios) {
    AddUnits(run, scenario, scenario.task == "capture" ? 4 : scenario.task == "detection" ? 6 : 8);
  }
  return run;
}

}  // namespace etude
