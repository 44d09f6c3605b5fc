#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/gate/baseline_file.h"
#include "bench/replay/replay.h"
#include "bench/results/folder.h"
#include "bench/run/outside_programs.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"

namespace etude {
namespace {

struct ReplayCommandOptions {
  std::string target;                 ///< a result folder, or a packed cell
  std::vector<std::string> cells;     ///< cell names; empty = all cells
  std::optional<std::size_t> sample;  ///< number of cells drawn by the run's seed; default: all
  std::string pack_file;              ///< the file into which one cell is packed instead of being replayed; "" = none
  std::string baseline;               ///< the baseline whose values are printed beside the replayed values; "" = none
  bool overwrite = false, as_json = false;
  int jobs = 0;
  OutsideRules outside;
  std::string key_file;
  Sealing sealing = Sealing::kRequired;
};

void PrintDifference(const CellCheck& check) {
  fmt::print("differs: {}\n  the first difference is in stage {}: {} in the run, {} now\n", check.cell, check.stage,
             check.then, check.now);
}

/// A metric's value in a baseline, and the metric's present value in the same cell.
struct BaselineValue {
  std::string metric;
  std::optional<double> baseline, now;
};

/// Finds the values of a cell in a baseline; empty if the baseline does not contain the cell.
std::vector<BaselineValue> ValuesOf(const Snapshot& baseline, const Row& row) {
  std::vector<BaselineValue> values;
  for (const SnapshotScenario& scenario : baseline.scenarios) {
    if (scenario.name != row.scenario) continue;
    for (const SnapshotCells& cells : scenario.cells) {
      if (cells.condition != CompactLabel(row.condition) || cells.method != row.method) continue;
      for (const SnapshotValues& metric : cells.metrics) {
        if (row.trial >= static_cast<int>(metric.values.size())) continue;
        values.push_back({metric.metric, metric.values[row.trial], ValueOf(row, metric.metric)});
      }
    }
  }
  return values;
}

void PrintBaseline(const std::string& file, const std::vector<BaselineValue>& values) {
  const auto text = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : "no value"; };
  if (values.empty()) fmt::print("  {} does not contain this cell\n", file);
  for (const BaselineValue& value : values) {
    const bool same = value.baseline == value.now;
    fmt::print("  {}: {} in the baseline, {}\n", value.metric, text(value.baseline),
               same ? "and now" : text(value.now) + " now");
  }
}

Json FactsOf(const std::vector<CellCheck>& checks, const Snapshot* baseline) {
  Json cells = Json::array();
  for (const CellCheck& check : checks) {
    Json& cell = cells.emplace_back(Json{{"cell", check.cell}, {"same", check.same}});
    if (!check.same) cell.update({{"stage", check.stage}, {"then", check.then}, {"now", check.now}});
    if (baseline == nullptr || !check.row) continue;
    for (const BaselineValue& value : ValuesOf(*baseline, *check.row)) {
      cell["baseline"][value.metric] = {OrNull(value.baseline), OrNull(value.now)};
    }
  }
  return {{"cells", std::move(cells)}};
}

Result<int> ReplayFile(const std::string& file, const OutsideRules& outside, const std::optional<SecretKey>& key,
                       bool as_json, const Interrupt& interrupt) {
  ASSIGN_OR_RETURN(const auto check, ReplayPack(file, outside, key, interrupt.requested()));
  if (!check) return TellStopped({{}, "stopped before the cell was run again"});
  if (as_json) {
    RETURN_IF_ERROR(PrintFacts("replay", FactsOf({*check}, nullptr)));
    return check->same ? kSuccess : kNothingWorked;
  }
  if (!check->same) {
    PrintDifference(*check);
    return kNothingWorked;
  }
  fmt::print("{}: all stages are identical\n", check->cell);
  return kSuccess;
}

Result<int> Pack(const ReplayCommandOptions& options) {
  if (options.cells.size() != 1) return Fail({}, "--pack packs exactly one cell; select this cell with --cell");
  RETURN_IF_ERROR(CheckOutput(options.pack_file, options.overwrite));
  RETURN_IF_ERROR(PackCell(options.target, options.cells.front(), options.pack_file, options.sealing));
  TellWritten(options.pack_file);
  fmt::print("Next, on any machine: etude replay {}\n", options.pack_file);
  return kSuccess;
}

Result<int> ReplayCommand(const ReplayCommandOptions& options) {
  const Interrupt interrupt;
  // If the target is a packed cell, replay this cell alone.
  ASSIGN_OR_RETURN(const auto key, TakeSecretKey(options.key_file));
  std::error_code error;
  if (!std::filesystem::is_directory(options.target, error)) {
    if (!options.cells.empty() || !options.pack_file.empty() || options.sample) {
      return Fail({options.target}, "is not a result folder, which --cell, --sample and --pack need");
    }
    return ReplayFile(options.target, options.outside, key, options.as_json, interrupt);
  }
  // Otherwise the target is a result folder: pack a cell, or replay cells.
  if (!options.pack_file.empty()) return Pack(options);
  std::optional<Snapshot> baseline;
  if (!options.baseline.empty()) {
    if (options.cells.empty()) return Fail({}, "--baseline needs cells; select cells with --cell");
    // Loading the run registers the metrics that the run's scenarios define.
    RETURN_IF_ERROR(LoadRunOutline(options.target, options.sealing));
    ASSIGN_OR_RETURN(baseline, TakeBaseline(options.baseline, options.sealing));
  }
  ASSIGN_OR_RETURN(const auto replayed, ReplayRun({.folder = options.target,
                                                   .cells = options.cells,
                                                   .sample = options.sample,
                                                   .jobs = options.jobs,
                                                   .outside = options.outside,
                                                   .key = key,
                                                   .sealing = options.sealing,
                                                   .stop = interrupt.requested(),
                                                   .on_progress = ProgressOf("cells")}));
  // Print the differences, and the baseline's values if they were requested.
  const std::vector<CellCheck>& checks = replayed.checks;
  const auto same = std::ranges::count(checks, true, &CellCheck::same);
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("replay", FactsOf(checks, baseline ? &*baseline : nullptr)));
  for (const CellCheck& check : checks) {
    if (options.as_json) break;
    if (!check.same) PrintDifference(check);
    if (!baseline || !check.row) continue;
    if (check.same) fmt::print("{}\n", check.cell);
    PrintBaseline(options.baseline, ValuesOf(*baseline, *check.row));
  }
  if (!options.as_json) fmt::print("{} of {} cells are identical to the run\n", same, checks.size());
  if (*interrupt.requested()) {
    std::fflush(stdout);
    return TellStopped({{}, "stopped; the remaining cells were not run again"});
  }
  return static_cast<std::size_t>(same) == checks.size() ? kSuccess : kNothingWorked;
}

}  // namespace

void DefineReplay(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReplayCommandOptions>();
  CLI::App* command =
      app.add_subcommand("replay", "Run cells again and compare the results with the run, stage by stage");
  command->add_option("target", options->target, "A result folder, or a packed cell that --pack wrote")->required();
  CLI::Option* cell = command->add_option("--cell", options->cells, "Names of the cells to run, as in cells.jsonl");
  command
      ->add_option("--sample", options->sample,
                   "Number of cells to run; the run's seed determines the random sample (default: all cells)")
      ->check(CLI::Range(1, 10'000'000))
      ->excludes(cell);
  AddUnsealed(*command, options->sealing);
  AddOutsideRules(*command, options->outside);
  AddSeedFile(*command, options->key_file);
  command->add_option("--pack", options->pack_file,
                      "Instead of running the cell, write the cell with its scenario and clips into this file");
  AddOverwrite(*command, options->overwrite);
  command->add_option("--baseline", options->baseline,
                      "Also print the values that each --cell has in this baseline file");
  AddJson(*command, options->as_json);
  AddJobs(*command, options->jobs);
  command->callback([=, &action] { action = [=] { return Finish(ReplayCommand(*options)); }; });
}

}  // namespace etude
