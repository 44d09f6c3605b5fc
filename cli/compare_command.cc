#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/finished_runs/finished_runs.h"
#include "bench/gate/comparison.h"
#include "bench/gate/systems.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/move_table.h"
#include "engine/base/names.h"
#include "reports/gate_table.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

/// Loads a complete run. Fails for an incomplete run, because the worlds of an incomplete run cannot be paired.
Result<FinishedRun> LoadWholeRun(const std::string& folder, Sealing sealing) {
  ASSIGN_OR_RETURN(auto run, LoadFinishedRun(folder, sealing));
  TellUnsealed(run.data.unsealed);
  if (!run.incomplete.empty()) return Fail({folder, 0, 0}, "{}", run.incomplete.front());
  return run;
}

/// Returns a sentence on the scope of the verdicts: two runs of the same worlds show only the effect of changed code.
std::string ScopeSentence(const FinishedRun& run) {
  std::vector<std::string_view> others;
  for (const FinishedScenario& scenario : run.scenarios) {
    const std::string_view other = OtherUnits(scenario.study.unit);
    if (std::ranges::find(others, other) == others.end()) others.push_back(other);
  }
  return fmt::format("All verdicts are about these worlds only, and not about {}.", fmt::join(others, ", "));
}

Result<int> CompareCommand(const std::string& a, const std::string& b, Sealing sealing, bool as_json) {
  ASSIGN_OR_RETURN(const auto run_a, LoadWholeRun(a, sealing));
  ASSIGN_OR_RETURN(const auto run_b, LoadWholeRun(b, sealing));
  Snapshot before = TakeSnapshot(run_a), after = TakeSnapshot(run_b);
  const std::vector<std::string> incomparable = DropIncomparable(before, after);
  const SnapshotComparison comparison = CompareSnapshots(before, after, {});
  const std::vector<std::string> systems = CompareSystems(run_a.data.system, run_b.data.system, before, after);
  if (std::ranges::all_of(comparison.moves, [](const MetricMove& move) { return move.worlds == 0; })) {
    return Fail({}, "{} and {} have no world in common that can be compared{}{}", a, b,
                incomparable.empty() ? "" : ": ", Join(incomparable, "; "));
  }
  // Print the comparison as JSON.
  if (as_json) {
    Json facts = FactsOf(comparison);
    facts["incomparable"] = incomparable;
    facts["systems"] = systems;
    facts["a_made_by"] = run_a.data.program_version;
    facts["b_made_by"] = run_b.data.program_version;
    RETURN_IF_ERROR(PrintFacts("compare", std::move(facts)));
    return kSuccess;
  }
  // Print the comparison as text: changed metrics, unmatched cells, and a summary.
  PrintMoves(comparison, "A", "B", comparison.moves.size());
  PrintList("Undecided, because the values cannot be compared:", NotAlikeLines(comparison));
  PrintList("Only in A:", comparison.only_before);
  PrintList("Only in B:", comparison.only_after);
  PrintList("Not compared, because the worlds differ:", incomparable);
  PrintList("Methods whose settings differ:", comparison.settings_changed);
  fmt::print("{}\n", CompareSentence(comparison));
  PrintVersions("A", run_a.data.program_version, "B", run_b.data.program_version);
  for (const std::string& line : systems) fmt::print("{}\n", line);
  if (!run_b.data.fence.empty() || !run_b.data.key_digest.empty()) {
    fmt::print("B: {}.\n", DescribeWorlds(run_b.data));
  }
  if (!comparison.moves.empty()) fmt::print("{}\n", ScopeSentence(run_b));
  return kSuccess;
}

}  // namespace

void DefineCompare(CLI::App& app, Action& action) {
  auto a = std::make_shared<std::string>(), b = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("compare", "Compare two runs of the same worlds");
  command->add_option("a", *a, "A result folder")->required();
  command->add_option("b", *b, "Another result folder")->required();
  auto sealing = std::make_shared<Sealing>();
  AddUnsealed(*command, *sealing);
  auto as_json = std::make_shared<bool>(false);
  AddJson(*command, *as_json);
  command->callback([=, &action] { action = [=] { return Finish(CompareCommand(*a, *b, *sealing, *as_json)); }; });
}

}  // namespace etude
