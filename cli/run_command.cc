#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "bench/metrics/catalogue.h"
#include "bench/results/folder.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"

namespace etude {
namespace {

std::string Value(const MethodSummary& method, const MetricInfo& metric) {
  for (const MetricSummary& summary : method.metrics) {
    if (summary.id != metric.id) continue;
    const auto& value = metric.aggregate == Aggregate::kMedian ? summary.median : summary.mean;
    return value ? fmt::format("{:.3g}", *value) : "-";
  }
  return "-";
}

bool IsSkipped(const ConditionSummary& condition) {
  return std::all_of(condition.methods.begin(), condition.methods.end(), [](const auto& method) {
    return method.statuses.size() == 1 && method.statuses.front().first == Status::kSkipped;
  });
}

/// Why nothing was measured under a condition of which every cell was skipped; else "".
std::string WhySkipped(const ConditionSummary& condition, const std::string& scenario, const std::vector<Row>& rows) {
  if (!IsSkipped(condition)) return "";
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
    return other.scenario == scenario && other.condition == condition.condition;
  });
  return row == rows.end() ? "" : row->result.reason;
}

/// One small table per condition: methods down, headline metrics across.
void PrintTables(const ScenarioSummary& scenario, const std::vector<Row>& rows) {
  constexpr std::size_t kShownMetrics = 4;
  std::vector<const MetricInfo*> metrics;
  for (const std::string& id : scenario.headline_metrics) {
    if (metrics.size() < kShownMetrics) metrics.push_back(FindMetric(id));
  }
  std::size_t width = 6;
  for (const std::string& method : scenario.methods) width = std::max(width, method.size());
  for (const ConditionSummary& condition : scenario.conditions) {
    if (const std::string why = WhySkipped(condition, scenario.name, rows); !why.empty()) {
      const std::string label = ConditionLabel(condition.condition);
      fmt::print("  {}{}skipped: {}\n", label, label.empty() ? "" : "  ", why);
      continue;
    }
    fmt::print("  {:<{}}", ConditionLabel(condition.condition), width + 2);
    for (const MetricInfo* metric : metrics) fmt::print("  {:>24}", metric->id);
    fmt::print("\n");
    for (const MethodSummary& method : condition.methods) {
      fmt::print("    {:<{}}", method.method, width);
      for (const MetricInfo* metric : metrics) fmt::print("  {:>24}", Value(method, *metric));
      fmt::print("\n");
    }
  }
}

void PrintSummary(const RunData& run) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    fmt::print("\n{} ({}): {}\n", scenario.name, scenario.task, scenario.question);
    PrintTables(scenario, run.rows);
    for (const ExpectationResult& expectation : scenario.expectations) {
      fmt::print("  {}: {} [{}]\n", RulingName(expectation.ruling), expectation.text, expectation.detail);
    }
  }
}

int ShowOutcome(const RunOutcome& outcome) {
  auto run = LoadRunOutline(outcome.folder);
  const auto has_skipped = [](const ScenarioSummary& scenario) {
    return std::ranges::any_of(scenario.conditions, IsSkipped);
  };
  if (run && std::ranges::any_of(run->scenarios, has_skipped)) run = LoadRun(outcome.folder);  // rows tell why
  if (!run) return Complain(run.error());
  PrintSummary(*run);
  const std::string folder = outcome.folder.string();
  fmt::print("\n{} of {} cells ok in {:.1f} s: {}\nNext: etude report {}\n", outcome.cells_ok, outcome.cells,
             outcome.seconds, folder, folder);
  return outcome.cells_ok > 0 ? kSuccess : kNothingWorked;
}

}  // namespace

int Complain(const Error& error) {
  std::fputs(("etude: " + ToString(error) + "\n").c_str(), stderr);
  return kUnusableInput;
}

int TellStopped(const Error& what_is_left) {
  Complain(what_is_left);
  return kInterrupted;
}

void TellUnsealed(const RunData& run) {
  if (!run.unsealed.empty()) std::fputs(("etude: read unsealed: " + run.unsealed + "\n").c_str(), stderr);
}

int RunCommand(const RunOptions& given) {
  RunOptions options = given;
  std::optional<Interrupt> interrupt(std::in_place);
  options.stop = interrupt->requested();
  ProgressBar bar;
  const auto outcome = Run(options, [&](const Progress& progress) { bar.Show(progress); });
  interrupt.reset();  // all is written
  if (!outcome) return Complain(outcome.error());
  const std::string folder = outcome->folder.string();
  for (const int line : outcome->damaged_lines) {
    Complain(
        {{(outcome->folder / kJournalFile).string(), line, 0}, "was not as it had been written; its cell ran again"});
  }
  if (outcome->fence.starts_with("none")) Complain({{}, "methods outside ran in no fence: " + outcome->fence});
  if (outcome->stopped) {
    return TellStopped({{},
                        outcome->cells == 0 ? "stopped before any cell ended; nothing is kept"
                                            : fmt::format("stopped; {} cells are kept in {}, --resume goes on",
                                                          outcome->cells, folder)});
  }
  if (!options.shard.IsWhole()) {
    fmt::print("Shard {}: {} of {} cells ok in {:.1f} s: {}\nNext, when all shards are done: etude merge DIR… -o DIR\n",
               ToString(options.shard), outcome->cells_ok, outcome->cells, outcome->seconds, folder);
    return outcome->cells_ok > 0 || outcome->cells == 0 ? kSuccess : kNothingWorked;
  }
  return ShowOutcome(*outcome);
}

int MergeCommand(const MergeOptions& given) {
  MergeOptions options = given;
  std::optional<Interrupt> interrupt(std::in_place);
  options.stop = interrupt->requested();
  // The first half is reading, in which shards that do not belong together are found: a complaint stands alone.
  ProgressBar reading(ProgressBar::Begins::kWhenItTakesLong), writing;
  const auto outcome = Merge(options, [&](double share) { (share < 0.5 ? reading : writing).Show(share, "merged"); });
  interrupt.reset();
  if (!outcome) return Complain(outcome.error());
  if (!outcome->stopped) return ShowOutcome(*outcome);
  return TellStopped({{}, "stopped; the shards are as they were, and there is no merged run"});
}

}  // namespace etude
