#include "cli/run_outcome.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/finished_runs/finished_runs.h"
#include "bench/gate/gate.h"
#include "bench/metrics/catalogue.h"
#include "bench/model/reasons.h"
#include "bench/results/folder.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/pair_notes.h"
#include "engine/base/names.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

std::string Value(const MethodSummary& method, const std::string& metric, const MetricWords& words) {
  const MetricSummary* summary = FindSummary(method, metric);
  return FormatValue(summary == nullptr ? std::nullopt : TypicalValue(*summary, words), words);
}

bool IsSkipped(const ConditionSummary& condition) {
  return std::all_of(condition.methods.begin(), condition.methods.end(), [](const auto& method) {
    return method.statuses.size() == 1 && method.statuses.front().first == Status::kSkipped;
  });
}

/// Returns the reason if every cell of a condition was skipped; else "".
std::string WhySkipped(const ConditionSummary& condition, const std::string& scenario, const std::vector<Row>& rows) {
  if (!IsSkipped(condition)) return "";
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
    return other.scenario == scenario && other.condition == condition.condition;
  });
  return row == rows.end() ? "" : row->result.reason;
}

std::string_view ArrowOf(Direction direction) {
  return direction == Direction::kNeither ? "" : direction == Direction::kLowerIsBetter ? " ↓" : " ↑";
}

/// Prints one small table per condition, with methods as rows and headline metrics as columns. An arrow shows whether
/// lower or higher values are better.
void PrintTables(const ScenarioSummary& scenario, const std::vector<Row>& rows) {
  constexpr std::size_t kShownMetrics = 4;
  const std::span<const std::string> metrics =
      std::span(scenario.headline_metrics).first(std::min(kShownMetrics, scenario.headline_metrics.size()));
  std::vector<MetricWords> words;
  std::vector<std::string> heads;
  for (const std::string& metric : metrics) {
    words.push_back(WordsFor(metric));
    heads.push_back(fmt::format("{}{}", words.back().label, ArrowOf(words.back().direction)));
  }
  const auto width_of = [&](std::size_t i) { return std::max<std::size_t>(10, CountCharacters(heads[i])); };
  std::size_t width = 6;
  for (const std::string& method : scenario.methods) width = std::max(width, method.size());
  for (const ConditionSummary& condition : scenario.conditions) {
    if (const std::string why = WhySkipped(condition, scenario.name, rows); !why.empty()) {
      const std::string label = ConditionLabel(condition.condition);
      fmt::print("  {}{}skipped: {}\n", label, label.empty() ? "" : "  ", why);
      continue;
    }
    fmt::print("  {:<{}}", ConditionLabel(condition.condition), width + 2);
    for (std::size_t i = 0; i < heads.size(); ++i) fmt::print("  {:>{}}", heads[i], width_of(i));
    fmt::print("\n");
    for (const MethodSummary& method : condition.methods) {
      fmt::print("    {:<{}}", method.method, width);
      for (std::size_t i = 0; i < heads.size(); ++i) {
        fmt::print("  {:>{}}", Value(method, metrics[i], words[i]), width_of(i));
      }
      fmt::print("\n");
    }
  }
  if (const std::size_t more = scenario.headline_metrics.size() - metrics.size(); more > 0)
    fmt::print("  (and {} in the report)\n", more == 1 ? "1 more metric" : fmt::format("{} more metrics", more));
}

/// Prints the answer of each scenario in one sentence. The report's page begins with the same sentences.
void PrintAnswers(const RunData& run) {
  std::vector<std::string> answers;
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.headline_metrics.empty()) continue;
    const std::string headline = HeadlineOf(scenario, MethodInQuestion(scenario), scenario.headline_metrics.front());
    if (!headline.empty()) answers.push_back(fmt::format("{}: {}", scenario.name, headline));
  }
  PrintList("\nAnswers:", answers);
}

/// Returns ", 191 unsolved (no answer, or an answer that missed the goal), 2 skipped, 4 could not be measured" without
/// the counts that are 0.
std::string OthersInWords(const RunData& run) {
  int unsolved = 0, skipped = 0, broken = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (const ConditionSummary& condition : scenario.conditions) {
      for (const MethodSummary& method : condition.methods) {
        for (const auto& [status, count] : method.statuses) {
          if (status == Status::kOk) continue;
          (status == Status::kUnsolved ? unsolved : status == Status::kSkipped ? skipped : broken) += count;
        }
      }
    }
  }
  std::string text;
  if (unsolved > 0) text += fmt::format(", {} unsolved (no answer, or an answer that missed the goal)", unsolved);
  if (skipped > 0) text += fmt::format(", {} skipped", skipped);
  if (broken > 0) text += fmt::format(", {} could not be measured", broken);
  return text;
}

/// Returns the metrics of the user's own that have no value, although cells are ok.
std::vector<std::string> SilentMetrics(const ScenarioSummary& scenario) {
  int ok = 0;
  std::map<std::string, int> present;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      ok += method.ok;
      for (const MetricSummary& metric : method.metrics) {
        if (AddedMetrics().contains(metric.id)) present[metric.id] += metric.present;
      }
    }
  }
  std::vector<std::string> silent;
  for (const auto& [id, count] : present) {
    if (ok > 0 && count == 0) silent.push_back(id);
  }
  return silent;
}

void PrintSummary(const RunData& run) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    fmt::print("\n{} ({}): {}\n", scenario.name, scenario.task, scenario.question);
    PrintTables(scenario, run.rows);
    for (const ExpectationResult& expectation : scenario.expectations) {
      fmt::print("  {}: {} [{}]\n", ClaimOutcomeName(expectation.outcome), expectation.text, expectation.detail);
    }
    for (const std::string& metric : SilentMetrics(scenario)) {
      fmt::print("  your metric {} has no value in any cell; `etude rows` shows the reasons\n", metric);
    }
  }
}

/// Returns true if a method attempted cells and none is ok. Only the rows then show whether the method gave an answer.
bool MayHaveSilentMethod(const ScenarioSummary& scenario) {
  return std::ranges::any_of(scenario.methods, [&](const std::string& name) {
    int attempted = 0, ok = 0;
    for (const ConditionSummary& condition : scenario.conditions) {
      const auto method = std::ranges::find(condition.methods, name, &MethodSummary::method);
      if (method == condition.methods.end()) continue;
      attempted += method->attempted;
      for (const auto& [status, count] : method->statuses) ok += status == Status::kOk ? count : 0;
    }
    return attempted > 0 && ok == 0;
  });
}

/// Returns the methods of a scenario that attempted cells but answered none (HasAnswer).
std::vector<std::string> SilentMethods(const RunData& run, const ScenarioSummary& scenario) {
  std::map<std::string, bool> answered;
  ForEachRow(run, [&](const Row& row, std::size_t) {
    if (row.scenario != scenario.name || row.result.status == Status::kSkipped) return;
    answered[row.method] |= HasAnswer(row.result);
  });
  std::vector<std::string> silent;
  std::ranges::copy_if(scenario.methods, std::back_inserter(silent),
                       [&](const std::string& name) { return answered.contains(name) && !answered.at(name); });
  return silent;
}

bool HasSilentMethod(const RunData& run) {
  return std::ranges::any_of(run.scenarios, [&](const ScenarioSummary& scenario) {
    return MayHaveSilentMethod(scenario) && !SilentMethods(run, scenario).empty();
  });
}

/// What a finished run tells besides its cells.
struct Finished {
  RunData run;                         ///< the summaries; also the rows if they hold needed reasons
  DoubtList doubts;                    ///< the doubts about judged files
  std::vector<FailureCount> failures;  ///< the cells without an answer, counted by reason
};

Result<Finished> ReadFinished(const std::filesystem::path& folder) {
  Finished finished;
  ASSIGN_OR_RETURN(finished.run, LoadRunOutline(folder));
  const std::vector<ScenarioSummary>& scenarios = finished.run.scenarios;
  const auto has_skipped = [](const ScenarioSummary& scenario) {
    return std::ranges::any_of(scenario.conditions, IsSkipped);
  };
  if (std::ranges::any_of(scenarios, has_skipped) || std::ranges::any_of(scenarios, MayHaveSilentMethod)) {
    ASSIGN_OR_RETURN(finished.run, LoadRun(folder));
  }
  // Read all rows only if they may hold a doubt or a failure.
  const auto judges_files = [](const ScenarioSummary& scenario) {
    return FindTaskKind(scenario.task) != nullptr && FindTaskKind(scenario.task)->find_files;
  };
  const auto has_failures = [](const ScenarioSummary& scenario) {
    return std::ranges::any_of(scenario.conditions, [](const ConditionSummary& condition) {
      return std::ranges::any_of(condition.methods,
                                 [](const MethodSummary& method) { return method.ok < method.attempted; });
    });
  };
  const bool may_doubt = std::ranges::any_of(scenarios, judges_files);
  const bool may_fail = std::ranges::any_of(scenarios, has_failures);
  if (!may_doubt && !may_fail) return finished;
  ASSIGN_OR_RETURN(const auto rows, LoadRunRowByRow(folder));
  if (may_doubt) finished.doubts = DoubtsOf(rows);
  if (may_fail) finished.failures = FailuresOf(rows);
  return finished;
}

/// Prints at most twenty failures of methods that answered in other cells.
void PrintFailures(const std::vector<FailureCount>& failures) {
  std::map<std::pair<std::string, std::string>, int> cells;
  for (const FailureCount& one : failures) cells[{one.scenario, one.method}] += one.cells;
  std::vector<std::string> lines;
  for (const FailureCount& one : failures) {
    if (cells.at({one.scenario, one.method}) < one.of) lines.push_back(DescribeFailure(one));
  }
  PrintList("\nCells without an answer:", FirstLines(std::move(lines), 20, "more; `etude rows` prints all cells"));
}

/// Returns the facts that `etude run --json` prints. A shard has no summaries, so it has only the numbers of `outcome`.
Json FactsOf(const RunOutcome& outcome, const Shard& shard, const Finished& finished) {
  Json scenarios = Json::array(), silent = Json::array(), failed = Json::array();
  for (const FailureCount& one : finished.failures) {
    failed.push_back({{"scenario", one.scenario},
                      {"method", one.method},
                      {"status", StatusName(one.status)},
                      {"reason", one.Words()},
                      {"cells", one.cells},
                      {"of", one.of}});
  }
  for (const ScenarioSummary& scenario : finished.run.scenarios) {
    Json expectations = Json::array();
    for (const ExpectationResult& one : scenario.expectations) {
      expectations.push_back(
          {{"expected", one.text}, {"outcome", ClaimOutcomeName(one.outcome)}, {"found", one.detail}});
    }
    scenarios.push_back(
        {{"scenario", scenario.name}, {"task", scenario.task}, {"expectations", std::move(expectations)}});
    if (!MayHaveSilentMethod(scenario)) continue;
    for (const std::string& method : SilentMethods(finished.run, scenario))
      silent.push_back(scenario.name + "/" + method);
  }
  return {{"output", outcome.folder.string()},
          {"shard", shard.IsWhole() ? Json(nullptr) : Json(ToString(shard))},
          {"cells", outcome.cells},
          {"cells_ok", outcome.cells_ok},
          {"run_s", outcome.seconds},
          {"scenarios", std::move(scenarios)},
          {"without_answer", std::move(silent)},
          {"failures", std::move(failed)},
          {"left_out", LeftOutIn(outcome)},
          {"doubts", finished.doubts.lines()}};
}

Result<int> Show(const RunOutcome& outcome, StdoutToStderr* aside) {
  ASSIGN_OR_RETURN(const Finished finished, ReadFinished(outcome.folder));
  const RunData& run = finished.run;
  PrintSummary(run);
  finished.doubts.Tell();
  const std::string folder = outcome.folder.string();
  const bool has_silent = HasSilentMethod(run);
  if (has_silent) {
    ASSIGN_OR_RETURN(const auto whole, LoadFinishedRun(folder));
    PrintList("\nMethods without an answer:", DescribeSilent(whole));
  }
  PrintFailures(finished.failures);
  PrintAnswers(run);
  fmt::print("\n{} of {} cells ok{} in {:.1f} s; results: {}\nNext: etude report {}\n", outcome.cells_ok, outcome.cells,
             OthersInWords(run), outcome.seconds, folder, folder);
  if (aside != nullptr) {
    aside->End();
    RETURN_IF_ERROR(PrintFacts("run", FactsOf(outcome, {}, finished)));
  }
  return outcome.cells_ok > 0 && !has_silent ? kSuccess : kNothingWorked;
}

}  // namespace

std::vector<std::string> LeftOutIn(const RunOutcome& outcome) {
  std::vector<std::string> lines;
  for (const RefusedClip& one : outcome.refused) lines.push_back(one.clip + ": " + one.why);
  return lines;
}

int ShowOutcome(const RunOutcome& outcome, StdoutToStderr* aside) { return Finish(Show(outcome, aside)); }

int ShowShard(const RunOutcome& outcome, const Shard& shard, StdoutToStderr* aside) {
  fmt::print(
      "Shard {}: {} of {} cells ok in {:.1f} s; results: {}\nNext, when all shards are finished: etude merge DIR… -o "
      "DIR\n",
      ToString(shard), outcome.cells_ok, outcome.cells, outcome.seconds, outcome.folder.string());
  if (aside != nullptr) {
    aside->End();
    if (const auto printed = PrintFacts("run", FactsOf(outcome, shard, {})); !printed) return Complain(printed.error());
  }
  return outcome.cells_ok > 0 || outcome.cells == 0 ? kSuccess : kNothingWorked;
}

}  // namespace etude
