#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "bench/dataset/export.h"
#include "bench/dataset/score.h"
#include "bench/run/run.h"
#include "bench/run/shipped.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"
#include "cli/run_outcome.h"
#include "engine/base/utf8.h"

namespace etude {
namespace {

void PrintFaults(const char* what, const std::vector<std::string>& faults) {
  constexpr std::size_t kMaxShown = 20;
  if (faults.empty()) return;
  std::string text = fmt::format("{} {}\n", faults.size(), what);
  for (std::size_t i = 0; i < std::min(faults.size(), kMaxShown); ++i) text += "  " + Visible(faults[i]) + "\n";
  if (faults.size() > kMaxShown) text += fmt::format("  … and {} more\n", faults.size() - kMaxShown);
  std::fputs(text.c_str(), stderr);
}

int ComplainOfFaults(const ScoreOptions& options, const PredictionFaults& faults) {
  PrintFaults("missing answers:", faults.missing);
  PrintFaults("extra answers, because no problem has this name:", faults.extra);
  PrintFaults("problems with more than one answer:", faults.duplicate);
  PrintFaults("broken answers:", faults.broken);
  const bool only_missing = faults.extra.empty() && faults.duplicate.empty() && faults.broken.empty();
  return Complain(
      {{options.predictions, 0, 0},
       fmt::format("nothing was scored; missing answers: {}, extra: {}, duplicates: {}, broken: {}{}",
                   faults.missing.size(), faults.extra.size(), faults.duplicate.size(), faults.broken.size(),
                   only_missing ? "; --allow-missing counts a missing answer as a failure" : "")});
}

int ExportAll(const ExportOptions& options) {
  const auto outcome =
      ExportSuite(options, ProgressOf("steps (three per world: make the problem, write the problem, write the truth)"));
  if (!outcome) return Complain(outcome.error());
  fmt::print(
      "{} problems in {}{}\nNext: give {}/inputs to your method, then run `etude score {} PREDICTIONS -o RESULT`\n",
      outcome->problems, options.output,
      outcome->skipped > 0 ? fmt::format(" ({} worlds were skipped; inputs/index.csv states why)", outcome->skipped)
                           : "",
      options.output, options.output);
  return kSuccess;
}

int ExportCommand(const ExportOptions& options) {
  return DoInterruptibly([&] { return ExportAll(options); }, [&] { RemoveUnfinishedExport(options.output); });
}

int ScoreCommand(const ScoreOptions& given) {
  const Interrupt interrupt;
  ScoreOptions options = given;
  options.stop = interrupt.requested();
  ProgressBar bar;
  const auto outcome = ScorePredictions(options, [&](const Progress& progress) { bar.Show(progress); });
  if (!outcome) return Complain(outcome.error());
  if (outcome->run.stopped) return TellStopped();
  if (!outcome->faults.empty()) return ComplainOfFaults(options, outcome->faults);
  return ShowOutcome(outcome->run);
}

}  // namespace

void DefineExport(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  options->program_version = ETUDE_VERSION;
  CLI::App* command = app.add_subcommand(
      "export", "Write the problems of scenarios as files for other programs, and the truth into a separate folder");
  command
      ->add_option("scenarios", options->scenarios,
                   "Scenario files, folders of scenario files, or names of scenarios that come with Etude")
      ->required();
  command->add_option("-o,--output", options->output, "The folder of the data set to write")->required();
  command->add_flag("--depth", options->depth,
                    "For capture scenarios: also write depth, labels and normals of every picture (EXR)");
  AddWorldOptions(*command, options->seed, options->trials, options->clips, options->joint_map, options->clip_facts);
  const Action act = WithSecretKey(*command, &options->seed, options->key, [=] {
    std::ranges::for_each(DescribeAmbiguousPaths(options->scenarios), Complain);
    return ExportCommand(*options);
  });
  AddReuseKey(*command, options->reuse_key);
  command->callback([=, &action] { action = act; });
}

void DefineScore(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = std::make_shared<ScoreOptions>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command =
      app.add_subcommand("score", "Score a folder of answers that another program made, and write a result folder");
  command
      ->add_option("target", options->target,
                   "A data set that `etude export` wrote, or the scenario files of the data set")
      ->required();
  command->add_option("predictions", options->predictions, "Folder of answers")->required();
  command->add_option("-o,--output", options->output, "Result folder")->required();
  command->add_option("--name", options->name, "Name of the method");
  AddOutsideRules(*command, options->outside);
  command->add_flag("--alone", options->alone, "Do not run the methods of the scenarios for comparison");
  command->add_flag("--allow-missing", options->allow_missing, "Count each world without an answer as a failed cell");
  AddJobs(*command, options->jobs);
  AddWorldOptions(*command, options->seed, options->trials, options->clips, options->joint_map, options->clip_facts);
  const Action act = WithSecretKey(*command, &options->seed, options->key, [=] { return ScoreCommand(*options); });
  command->callback([=, &action] { action = act; });
}

}  // namespace etude
