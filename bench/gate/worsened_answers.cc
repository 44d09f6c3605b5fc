#include "bench/gate/worsened_answers.h"

#include <fmt/core.h>

#include <algorithm>

#include "bench/metrics/catalogue.h"
#include "bench/statistics/summary.h"

namespace etude {
namespace {

bool Keeps(const SnapshotScenario& snapshot, const std::string& metric) {
  return std::ranges::find(snapshot.metrics, metric, &std::pair<std::string, int>::first) != snapshot.metrics.end();
}

/// Returns true if a snapshot contains every metric that is needed to compute the answers of a study.
bool KeepsAnswers(const Study& study, const SnapshotScenario& snapshot) {
  std::vector<std::string> needed = study.metrics;
  if (!study.success.empty()) needed.push_back(study.success);
  for (const std::string& id : std::vector(needed)) {
    if (const std::string& weight = FindMetric(id)->weight; !weight.empty()) needed.push_back(weight);
  }
  return std::ranges::all_of(needed, [&](const std::string& id) { return Keeps(snapshot, id); });
}

/// Computes the summary of a study, with its verdicts, from the values in a snapshot. Each world counts as its own
/// sampling unit: snapshots do not contain the units, and the compared verdicts are about the run's worlds alone.
ScenarioSummary SummaryOf(Study study, const SnapshotScenario& snapshot) {
  study.unit = SamplingUnit::kWorld;
  study.expectations.clear();
  // The comparison with the strongest other method is not needed. That comparison leaves out methods with oracles, so
  // all methods are marked as having one.
  for (ComparedMethod& method : study.methods) method.has_oracle = true;
  ScenarioTable table(study);
  Row row;
  row.scenario = study.scenario;
  for (const SnapshotCells& cells : snapshot.cells) {
    const auto condition =
        std::ranges::find(study.conditions, cells.condition, [](const auto& swept) { return CompactLabel(swept); });
    if (condition == study.conditions.end()) continue;
    row.condition = *condition;
    row.method = cells.method;
    for (row.trial = 0; row.trial < study.trials; ++row.trial) {
      const auto trial = static_cast<std::size_t>(row.trial);
      row.result = CellResult::Ended(StatusOf(cells.statuses[trial]), "");
      for (const SnapshotValues& kept : cells.metrics) {
        if (kept.values[trial]) row.result.Measure(kept.metric, *kept.values[trial]);
      }
      if (!cells.judged.empty()) row.result.judged = cells.judged[trial];
      table.Add(row);
    }
  }
  return Summarise(study, table, snapshot.seed);
}

bool HasWorsened(Verdict before, Verdict after) {
  if (before == Verdict::kBetter) return after == Verdict::kNoDifference || after == Verdict::kWorse;
  return before == Verdict::kNoDifference && after == Verdict::kWorse;
}

}  // namespace

std::vector<WorsenedAnswer> FindWorsenedAnswers(const FinishedRun& run, const Snapshot& before, const Snapshot& after,
                                                std::span<const MetricMove> moves) {
  std::vector<WorsenedAnswer> worsened;
  for (const FinishedScenario& one : run.scenarios) {
    const std::string& name = one.study.scenario;
    const bool differs = std::ranges::any_of(
        moves, [&](const MetricMove& move) { return move.identity.scenario == name && move.differing > 0; });
    const auto was = std::ranges::find(before.scenarios, name, &SnapshotScenario::name);
    const auto is = std::ranges::find(after.scenarios, name, &SnapshotScenario::name);
    if (!differs || was == before.scenarios.end() || is == after.scenarios.end() || was->trials != is->trials) continue;
    if (!KeepsAnswers(one.study, *was) || !KeepsAnswers(one.study, *is)) continue;
    const ScenarioSummary then = SummaryOf(one.study, *was), now = SummaryOf(one.study, *is);
    for (std::size_t c = 0; c < now.conditions.size(); ++c) {
      for (std::size_t i = 0; i < now.conditions[c].answers.size(); ++i) {
        const Answer &old = then.conditions[c].answers[i], &answer = now.conditions[c].answers[i];
        if (!HasWorsened(old.verdict, answer.verdict)) continue;
        worsened.push_back({name, CompactLabel(now.conditions[c].condition), answer.method, answer.baseline,
                            old.verdict, answer.verdict});
      }
    }
  }
  return worsened;
}

std::string DescribeWorsened(const WorsenedAnswer& one) {
  return fmt::format("{}{}: {} against {}: {} before, now {}", one.scenario,
                     one.condition == "-" ? "" : ", " + one.condition, one.method, one.baseline,
                     VerdictName(one.before), VerdictName(one.after));
}

}  // namespace etude
