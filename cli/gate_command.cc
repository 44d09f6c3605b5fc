#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/finished_runs/finished_runs.h"
#include "bench/gate/baseline_file.h"
#include "bench/gate/gate.h"
#include "bench/gate/self_test.h"
#include "bench/results/folder.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/move_table.h"
#include "cli/pair_notes.h"
#include "io/files/files.h"
#include "reports/gate_table.h"
#include "reports/report.h"

namespace etude {
namespace {

struct GateOptions {
  std::string target;         ///< a result folder; with self_test a scenario file, "" = the built-in scenario
  std::string baseline;       ///< a baseline file, "" = none
  bool update = false;        ///< write the baseline from the run, and print the metrics that changed
  bool self_test = false;     ///< measure the gate's own rates of false alarms and of detection
  int repetitions = 40;       ///< for the self-test: number of pairs of runs with different seeds
  std::optional<int> trials;  ///< for the self-test: worlds per condition; default: the scenario's trials
  bool as_json = false;
  Sealing sealing = Sealing::kRequired;
};

namespace fs = std::filesystem;

constexpr std::size_t kMaxRows = 40;
constexpr std::size_t kMaxWorldsEach = 5, kMaxWorlds = 20;

int ExitCode(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kPassed:
      return kSuccess;
    case GateVerdict::kRegressed:
      return kRegression;
    case GateVerdict::kIncomplete:
      break;
  }
  return kIncompleteRun;
}

/// Prints the worlds that are far worse than in the baseline. Each world has two lines: the difference, and the command
/// that runs the world again. A line without a command counts the worlds that are left out.
void PrintWorlds(const std::string& title, const std::vector<TailLine>& lines) {
  std::vector<std::string> text;
  for (const TailLine& line : lines) {
    text.push_back(line.world);
    if (!line.replay.empty()) text.push_back("  " + line.replay);
  }
  PrintList(title, text);
}

void PrintReport(const GateReport& report) {
  PrintList("Verdicts that became worse:", WorsenedLines(report));
  PrintMoves(report.comparison, "baseline", "now", kMaxRows);
  for (const TailGroup group : {TailGroup::kFailing, TailGroup::kTooFew, TailGroup::kNotJudged}) {
    PrintWorlds(std::string(TailHeading(group)), TailLines(report, group, kMaxWorldsEach, kMaxWorlds));
  }
  for (const GateExpectation& e : report.expectations) {
    if (e.result.outcome != ClaimOutcome::kUnmet) continue;
    fmt::print("{}: {}: {} [{}]\n", ClaimOutcomeName(e.result.outcome), e.scenario, e.result.text, e.result.detail);
  }
  for (const RatioResult& ratio : report.ratios) {
    fmt::print("{}: {}: {} [{}]\n", ClaimOutcomeName(ratio.outcome), ratio.scenario, RatioClaim(ratio),
               RatioDetail(ratio));
  }
  PrintList("Undecided, because the values cannot be compared:", NotAlikeLines(report.comparison));
  PrintList("New, not in the baseline:", report.comparison.only_after);
  PrintList("Methods whose settings in the scenario changed:", report.comparison.settings_changed);
  PrintList("Without an answer or a value in any cell:", report.silent);
  PrintList("Incomplete:", report.incomplete);
  if (!report.baseline_version.empty())
    PrintVersions("the baseline", report.baseline_version, "the run", report.program_version);
  for (const std::string& sentence : GateSentences(report)) fmt::print("{}\n", sentence);
  const std::vector<std::string> reversed = WorsenedLines(report, true);
  fmt::print("Gate: {}{}{}\n", GateVerdictWords(GateVerdictOf(report)),
             reversed.empty() ? "" : ": " + Join(reversed, "; "),
             report.baseline_file.empty() ? ", without a baseline (--baseline FILE --update writes a baseline)" : "");
}

/// Returns, as JSON, the worlds in which a metric became far worse.
Json FarWorseWorlds(const GateReport& report, const RunData& run) {
  Json worlds = Json::array();
  for (const MetricMove& move : report.comparison.moves) {
    for (const TailWorld& world : move.tail) {
      const std::string cell = CellOf(move.identity, world.trial);
      worlds.push_back({{"cell", cell},
                        {"metric", move.identity.metric},
                        {"before", OrNull(world.before)},
                        {"after", OrNull(world.after)},
                        {"status_before", StatusName(StatusOf(world.ended_before))},
                        {"status_after", StatusName(StatusOf(world.ended_after))},
                        {"fails", IsRegression(move)},
                        {"replay", ReplayCommand(report, cell)}});
      const auto place = FindRow(run, cell);
      const std::string reason = place ? RowAt(run, *place).result.reason : "";
      if (!reason.empty()) worlds.back()["reason"] = reason;
    }
  }
  return worlds;
}

Json FactsOf(const GateReport& report, const RunData& run) {
  Json facts = {{"verdict", GateVerdictWords(GateVerdictOf(report))},
                {"made_by", report.program_version},
                {"baseline_made_by", report.baseline_file.empty() ? Json() : Json(report.baseline_version)}};
  facts.update(FactsOf(report.comparison));
  facts["far_worse_worlds"] = FarWorseWorlds(report, run);
  Json& expectations = facts["expectations"] = Json::array();
  for (const GateExpectation& e : report.expectations) {
    expectations.push_back(
        {{"scenario", e.scenario}, {"ruling", ClaimOutcomeName(e.result.outcome)}, {"text", e.result.text}});
  }
  Json& answers = facts["answers"] = Json::array();
  for (const auto& [scenario, condition, answer] : report.answers) {
    answers.push_back({{"scenario", scenario},
                       {"condition", condition},
                       {"method", answer.method},
                       {"baseline", answer.baseline},
                       {"verdict", VerdictName(answer.verdict)},
                       {"decided_by", NameOfValue(kAnswerSteps, answer.decided_by)}});
  }
  facts["fallen"] = WorsenedLines(report);
  facts["silent"] = report.silent;
  facts["incomplete"] = report.incomplete;
  return facts;
}

Result<int> Judge(const GateOptions& options, const FinishedRun& run) {
  // Remove an earlier verdict first, so that it is not taken for the one of a gate that fails.
  const FilePath folder = Inside(options.target) / "report";
  RETURN_IF_ERROR(PlainFilesBelow(folder));  // refuse links, which could lead out of the folder
  for (const char* file : {kGateMarkdown, kGateJunit}) RETURN_IF_ERROR(RemoveFile(folder / file));
  std::optional<Snapshot> baseline;
  if (!options.baseline.empty()) {
    if (std::error_code none; !fs::exists(options.baseline, none)) {
      return Fail({options.baseline, 0, 0}, "does not exist; --update writes this baseline from the run");
    }
    ASSIGN_OR_RETURN(baseline, TakeBaseline(options.baseline, options.sealing));
  }
  ASSIGN_OR_RETURN(auto report, JudgeRun(run, baseline ? &*baseline : nullptr, options.baseline));
  report.run_folder = options.target;
  report.doubts = DoubtsOf(run.data).Kinds();
  RETURN_IF_ERROR(WriteFileAtomically(folder / kGateMarkdown, WriteGateMarkdown(report)));
  RETURN_IF_ERROR(WriteFileAtomically(folder / kGateJunit, WriteGateJunit(report)));
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("gate", FactsOf(report, run.data)));
  } else {
    PrintReport(report);
  }
  return UnlessReplaced(options.target, run.data, ExitCode(GateVerdictOf(report)));
}

/// Prints the metrics that changed between two baselines, for the worlds that are in both baselines.
void PrintDifference(Snapshot before, Snapshot after, const FinishedRun& run) {
  PrintList("Not compared with the old baseline:", DropIncomparable(before, after));
  const SnapshotComparison comparison = CompareSnapshots(before, after, ExactScenarios(run), TailRulesOf(run));
  PrintMoves(comparison, "was", "is", kMaxRows);
  PrintList("Removed from the baseline:", comparison.only_before);
  PrintList("Added to the baseline:", comparison.only_after);
}

Result<int> Update(const GateOptions& options, const FinishedRun& run) {
  // Refuse to make a baseline from an incomplete run, or from a run with a method without answers, or an own metric
  // without values.
  if (const auto incomplete = WhyIncomplete(run); !incomplete.empty()) {
    PrintList("No baseline was written, because the run is incomplete:", incomplete);
    return kIncompleteRun;
  }
  if (const auto silent = DescribeSilent(run); !silent.empty()) {
    PrintList(
        "No baseline was written. No later run could be worse than a method without answers or a metric without "
        "values:",
        silent);
    return kRegression;
  }
  // Check that the new baseline can be read back, before the old baseline is replaced.
  const Snapshot now = TakeSnapshot(run);
  ASSIGN_OR_RETURN(const auto text, WriteBaseline(now));
  RETURN_IF_ERROR(ReadBaseline(text, options.target));
  std::optional<Snapshot> before;
  if (std::error_code none; fs::exists(options.baseline, none)) {
    // Refuse to overwrite a file that is not a baseline.
    ASSIGN_OR_RETURN(before, TakeBaseline(options.baseline, Sealing::kIgnored));
  }
  RETURN_IF_ERROR(WriteFileAtomically(options.baseline, text));
  if (before) PrintDifference(std::move(*before), now, run);
  fmt::print("{}: {}, {} bytes\n", options.baseline, before ? "updated" : "made", text.size());
  return kSuccess;
}

std::string RateText(const Rate& rate) {
  return fmt::format("{} of {} ({:.1f} %, 95 % interval {:.1f}–{:.1f} %)", rate.count, rate.of,
                     rate.of == 0 ? 0.0 : 100.0 * rate.count / rate.of, 100 * rate.low, 100 * rate.high);
}

/// Returns a sentence that says whether the gate keeps its error limits. A few repetitions without a false alarm are
/// not enough to prove this.
const char* PromiseSentence(const SelfTestReport& report) {
  if (!report.Holds()) return "The gate exceeds its error limits.";
  if (report.false_alarms.high > kFalseAlarmLimit) {
    return "The gate seems to keep its error limits. More repetitions are needed to confirm this.";
  }
  return "The gate keeps its error limits.";
}

Result<int> SelfTest(const GateOptions& options) {
  ASSIGN_OR_RETURN(const auto rehearsal, ReadRehearsal(options.target, options.trials));
  ASSIGN_OR_RETURN(const auto report,
                   RunSelfTest([&](std::uint64_t seed) { return RunInProcess(rehearsal, seed); }, options.repetitions));
  fmt::print("{} ({}), {} worlds per condition, {} comparisons per gate\n\n", rehearsal.setup.name,
             rehearsal.setup.file, rehearsal.setup.trials, report.comparisons);
  fmt::print("False alarms (nothing had changed)\n");
  fmt::print("  reruns with the same seed, rule `exact`:   {}\n", RateText(report.rerun_alarms));
  fmt::print("  reruns with the same seed, tail rule:      {}\n", RateText(report.tail_rerun_alarms));
  fmt::print("  gates between two seeds:                   {}; at most {:.0f} % by design\n",
             RateText(report.false_alarms), 100 * kFalseAlarmLimit);
  fmt::print("  single comparisons of these gates:         {}\n", RateText(report.false_alarm_comparisons));
  for (const auto& [title, results] :
       {std::pair{"Detected differences (of differences that the self-test added)", &report.injected},
        std::pair{"Detected worlds that are far worse", &report.tails},
        std::pair{"Detected changes of real settings", &report.real}}) {
    if (!results->empty()) fmt::print("{}\n", title);
    for (const PowerResult& result : *results) fmt::print("  {}: {}\n", result.change, RateText(result.found));
  }
  fmt::print("\n{}\n", PromiseSentence(report));
  return report.Holds() ? kSuccess : kRegression;
}

Result<int> GateCommand(const GateOptions& options) {
  if (options.target.empty() && !options.self_test) return Fail({}, "`etude gate` needs a result folder");
  if (options.self_test) return SelfTest(options);
  ASSIGN_OR_RETURN(const auto run, LoadFinishedRun(options.target, options.sealing));
  TellUnsealed(run.data.unsealed);
  return options.update ? Update(options, run) : Judge(options, run);
}

}  // namespace

void DefineGate(CLI::App& app, Action& action) {
  auto options = std::make_shared<GateOptions>();
  CLI::App* command = app.add_subcommand("gate", "Compare a run with a baseline, and pass or fail, for a CI server");
  command->add_option("folder", options->target, "A result folder. With --self-test: a scenario file, or nothing");
  CLI::Option* baseline =
      command->add_option("--baseline", options->baseline,
                          "The baseline file that the run is compared with. Without a baseline, the gate judges only "
                          "the expectations and time rules of the run's scenarios");
  CLI::Option* update = command->add_flag("--update", options->update,
                                          "Write the baseline file from this run, and print what changed in it");
  update->needs(baseline);
  CLI::Option* self_test = command
                               ->add_flag("--self-test", options->self_test,
                                          "Measure how often the gate raises false alarms and misses differences")
                               ->excludes(baseline);
  command->add_option("--repetitions", options->repetitions, "Self-test: number of pairs of seeds")
      ->check(CLI::Range(1, 100000))
      ->needs(self_test);
  command
      ->add_option("--trials", options->trials,
                   "Self-test: number of worlds per condition (default: the scenario's number)")
      ->check(CLI::Range(1, 1000000))
      ->needs(self_test);
  AddUnsealed(*command, options->sealing);
  CLI::Option* json = AddJson(*command, options->as_json);
  json->excludes(self_test, update);
  command->callback([=, &action] { action = [=] { return Finish(GateCommand(*options)); }; });
}

}  // namespace etude
