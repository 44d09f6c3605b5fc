#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/results/folder.h"
#include "bench/run/run.h"
#include "bench/run/shipped.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "cli/run_outcome.h"

namespace etude {
namespace {

/// Warns if no lock keeps a second run from writing into the folder.
void TellUnlocked(const RunOutcome& outcome) {
  if (outcome.why_unlocked.empty()) return;
  Complain({{outcome.folder.string(), 0, 0},
            fmt::format("could not be locked ({}); make sure that no other run writes into this folder",
                        outcome.why_unlocked)});
}

/// Prints the changes that were made to the content of the clips' files, one per line. Prints at most the first 40
/// changes.
void TellChanges(const std::vector<LoadedChange>& changes) {
  constexpr std::size_t kShown = 40;
  for (std::size_t i = 0; i < std::min(changes.size(), kShown); ++i) {
    fmt::print("{}: {}\n", changes[i].clip, changes[i].change);
  }
  if (changes.size() > kShown)
    fmt::print("… and {} more changes of clips; manifest.json lists all of them\n", changes.size() - kShown);
}

}  // namespace

Result<std::optional<RunOutcome>> RunWithProgress(RunOptions options) {
  // Run the scenarios; Ctrl-C requests a stop.
  std::optional<Interrupt> interrupt(std::in_place);
  options.stop = interrupt->requested();
  ProgressBar bar;
  ASSIGN_OR_RETURN(auto outcome, Run(options, [&](const Progress& progress) { bar.Show(progress); }));
  interrupt.reset();  // everything is written, so from here on Ctrl-C ends the program
  // Report a folder without a lock, and what was changed, left out or ignored.
  TellUnlocked(outcome);
  TellChanges(outcome.changes);
  for (const RefusedClip& one : outcome.refused) Complain({{one.clip}, "was left out: " + one.why});
  std::ranges::for_each(outcome.unfilmed, Complain);
  const std::string folder = outcome.folder.string();
  for (const int line : outcome.damaged_lines) {
    Complain({{(outcome.folder / kJournalFile).string(), line, 0},
              "Etude ignored this line, because it is damaged or another line contains the same cell"});
  }
  if (outcome.fence.starts_with("none"))
    Complain({{}, "outside methods ran without a sandbox (fence): " + outcome.fence});
  // If the run was stopped, say that the finished cells are kept for --resume.
  if (!outcome.stopped) return std::optional(std::move(outcome));
  const std::size_t kept = outcome.cells + outcome.cells_answered;
  TellStopped({{},
               kept == 0 ? "stopped before any cell ended; no result was kept"
                         : fmt::format("stopped; {0} finished cells were kept in {1}; use --resume to continue", kept,
                                       folder)});
  return std::optional<RunOutcome>();
}

namespace {

int RunCommand(const RunOptions& options, bool as_json) {
  StdoutToStderr aside(as_json);
  const auto finished = RunWithProgress(options);
  if (!finished) return Complain(finished.error());
  if (!*finished) return kInterrupted;
  const RunOutcome& outcome = **finished;
  StdoutToStderr* const facts = as_json ? &aside : nullptr;
  return options.shard.IsWhole() ? ShowOutcome(outcome, facts) : ShowShard(outcome, options.shard, facts);
}

int MergeCommand(const MergeOptions& given) {
  MergeOptions options = given;
  std::optional<Interrupt> interrupt(std::in_place);
  options.stop = interrupt->requested();
  // In the first half of its work, Merge only reads the shards and finds shards that do not belong together. The bar of
  // this half appears late, so that error messages are not printed beside it.
  ProgressBar reading(ProgressBar::Begins::kWhenItTakesLong), writing;
  const auto outcome = Merge(options, [&](double share) { (share < 0.5 ? reading : writing).Show(share, "merged"); });
  interrupt.reset();
  if (!outcome) return Complain(outcome.error());
  TellUnlocked(*outcome);
  if (!outcome->stopped) return ShowOutcome(*outcome);
  return TellStopped({{}, "stopped; Etude wrote no merged run, and the shards are unchanged"});
}

void AddOtherLibraries(CLI::App& command, bool& other_libraries) {
  command.add_flag(
      "--other-libraries", other_libraries,
      "Continue even if software libraries have changed since the run began (other_libraries.json lists the changes)");
}

}  // namespace

void DefineRun(CLI::App& app, const std::string& command_line, Action& action) {
  // Define the options that choose worlds, workers and outputs.
  auto options = std::make_shared<RunOptions>();
  auto shard = std::make_shared<std::string>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("run", "Run scenarios and write the results into a folder");
  command->add_option(
      "scenarios", options->scenarios,
      "Scenario files, folders of scenario files, or names of scenarios that come with Etude (quick, full/ik_weights)");
  command->add_option(
      "-o,--output", options->output,
      "Result folder (default: out/<suite>-<seed>; with a secret key, out/<suite>-<digest of the key>)");
  AddJobs(*command, options->jobs);
  const auto world_options = AddWorldOptions(*command, options->seed, options->trials, options->clips,
                                             options->joint_map, options->clip_facts);
  CLI::Option* skip_refused = command->add_flag("--skip-refused", options->skip_refused,
                                                "Leave out clips that cannot be read; the manifest lists these clips");
  CLI::Option* keep = command
                          ->add_option_function<std::string>(
                              "--keep", [options](const std::string&) { options->keeps_motions = true; },
                              "motions: record the motions of every cell (the scenario key `video` records some cells)")
                          ->check(OneOf({"motions"}));
  auto dry_run = std::make_shared<bool>(false), as_json = std::make_shared<bool>(false);
  const Action act = WithSecretKey(*command, &options->seed, options->key, [=] {
    return *dry_run ? DryRunCommand(*options, *as_json) : RunCommand(*options, *as_json);
  });
  AddReuseKey(*command, options->reuse_key);
  // Define the options for parts of a run, and for continuing a run.
  command->add_option("--shard", *shard,
                      "Run only part i of n, given as i/n; `etude merge` combines all parts into one run");
  CLI::Option* overwrite = AddOverwrite(*command, options->overwrite, "Replace the run in the result folder");
  CLI::Option* resume =
      command->add_flag("--resume", options->resume, "Continue the run in the result folder")->excludes(overwrite);
  AddOtherLibraries(*command, options->other_libraries);
  AddOutsideRules(*command, options->outside);
  command
      ->add_option("--sync-seconds", options->sync.seconds,
                   "Longest time until a finished cell is written to disk, in s")
      ->check(NumberWithin(0, 3600, "time in s"));
  command
      ->add_option("--sync-mebibytes", options->sync.mebibytes,
                   "Largest amount of results that are not yet written to disk, in MiB")
      ->check(NumberWithin(0, 1024, "size in MiB"));
  CLI::Option* dry =
      command->add_flag("--dry-run", *dry_run,
                        "Only estimate the time of the run, and the smallest differences that the run could detect");
  dry->excludes(overwrite, resume);
  AddJson(*command, *as_json);
  // --from repeats a run from its manifest, so it excludes all options whose values are in the manifest.
  CLI::Option* from = command->add_option("--from", options->from, "Repeat the run that this manifest.json describes");
  for (CLI::Option* option : world_options) from->excludes(option);
  from->excludes(skip_refused, keep);
  from->excludes(
      command->add_option("--library", options->libraries,
                          "NAME=CLIPS: an additional clip library; every condition is also run with these clips"));
  CLI::Option* streams = command->add_option("--streams", options->streams,
                                             "Recordings of skeletons that replace simulated people: files, patterns "
                                             "of file names, or folders (docs/streams.md)");
  streams->excludes(from, world_options[2]);
  from->excludes(command->add_option("--labels", options->labels,
                                     "Labels of --streams or --clips (which person performed which move, and when): a "
                                     "file, or a folder of tag streams"));
  // Check combinations that CLI11 cannot express, and start the run.
  command->callback([=, &action] {
    action = [=] {
      if (options->scenarios.empty() == options->from.empty()) {
        return Complain({{}, "`etude run` needs scenario files or folders, or the option --from with a manifest.json"});
      }
      if (!shard->empty()) {
        const auto part = ParseShard(*shard);
        if (!part) return Complain({{}, "--shard: " + part.error().message});
        options->shard = *part;
      }
      std::ranges::for_each(DescribeAmbiguousPaths(options->scenarios), Complain);
      return act();
    };
  });
}

void DefineScenario(CLI::App& app, Action& action) {
  auto name = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("scenario", "Copy scenarios that come with Etude");
  CLI::App* copy = command->add_subcommand("copy", "Copy a scenario or a suite, so that you can edit the copy");
  command->require_subcommand(1);
  copy->add_option("scenario", *name,
                   "The name of the scenario or suite, such as full/ik_weights or quick (see `etude list scenarios`)")
      ->required();
  copy->add_option("folder", *folder, "The folder into which the files are copied")->required();
  copy->callback([=, &action] {
    action = [=] {
      const auto written = CopyShipped(*name, *folder);
      if (!written) return Complain(written.error());
      for (const auto& file : *written) TellWritten(file.string());
      return kSuccess;
    };
  });
}

void DefineMerge(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = std::make_shared<MergeOptions>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("merge", "Merge the shards of a run into one run");
  command->add_option("folders", options->folders, "The folders of all shards, in any order")->required();
  command->add_option("-o,--output", options->output, "Result folder")->required();
  AddOverwrite(*command, options->overwrite, "Replace the run in the result folder");
  AddOtherLibraries(*command, options->other_libraries);
  const Action act = WithSecretKey(*command, nullptr, options->key, [=] { return MergeCommand(*options); });
  command->callback([=, &action] { action = act; });
}

}  // namespace etude
