#include <fmt/core.h>

#include <algorithm>
#include <csignal>

#include "bench/metrics/catalogue.h"
#include "bench/results/folder.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"

namespace etude {
namespace {

std::atomic<bool> stop_requested = false;

void RequestStop(int) { stop_requested = true; }

std::string Value(const MethodSummary& method, const MetricInfo& metric) {
  for (const MetricSummary& summary : method.metrics) {
    if (summary.id != metric.id) continue;
    const auto& value = metric.aggregate == Aggregate::kMedian ? summary.median : summary.mean;
    return value ? fmt::format("{:.3g}", *value) : "-";
  }
  return "-";
}

/// One small table per scenario and condition: methods down, headline metrics across.
void PrintTable(const ScenarioSummary& scenario) {
  constexpr std::size_t kColumns = 4;
  std::vector<const MetricInfo*> metrics;
  for (const std::string& id : scenario.headline_metrics) {
    if (metrics.size() < kColumns) metrics.push_back(FindMetric(id));
  }
  std::size_t width = 6;
  for (const std::string& method : scenario.methods) width = std::max(width, method.size());
  for (const ConditionSummary& condition : scenario.conditions) {
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
    PrintTable(scenario);
    for (const ExpectationResult& expectation : scenario.expectations) {
      fmt::print("  {}: {} [{}]\n", OutcomeName(expectation.outcome), expectation.text, expectation.detail);
    }
  }
}

}  // namespace

int Complain(const Error& error) {
  fmt::print(stderr, "etude: {}\n", ToString(error));
  return kBadInput;
}

int RunCommand(const RunOptions& given) {
  RunOptions options = given;
  options.stop = &stop_requested;
  std::signal(SIGINT, RequestStop);
  std::signal(SIGTERM, RequestStop);
  std::signal(SIGPIPE, SIG_IGN);  // a worker that died is a row, not our end
  ProgressBar bar;
  const auto outcome = Run(options, [&](const Progress& progress) { bar.Show(progress); });
  if (!outcome) return Complain(outcome.error());
  if (outcome->stopped) {
    fmt::print(stderr, "\netude: stopped; {} cells are in {}/journal.jsonl\n", outcome->cells, outcome->folder.string());
    return kInterrupted;
  }
  const auto run = LoadRun(outcome->folder);
  if (!run) return Complain(run.error());
  PrintSummary(*run);
  fmt::print("\n{} of {} cells ok in {:.1f} s: {}\nNext: etude report {}\n", outcome->cells_ok, outcome->cells,
             outcome->seconds, outcome->folder.string(), outcome->folder.string());
  return outcome->cells_ok > 0 ? kSuccess : kNothingWorked;
}

}  // namespace etude
