#include "cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <memory>

#include "bench/run/worker.h"
#include "bench/tasks/registry.h"
#include "cli/bridge_arguments.h"
#include "cli/calibrate_command.h"
#include "cli/capture_command.h"
#include "cli/clip_arguments.h"
#include "cli/coach_command.h"
#include "cli/commands.h"
#include "cli/common_arguments.h"
#include "cli/crowd_command.h"
#include "cli/sensor_arguments.h"
#include "cli/stream_arguments.h"
#include "cli/train_arguments.h"
#include "cli/validators.h"
#include "engine/base/names.h"

namespace etude {
namespace {

/// The options of a command live as long as the parser and the action that will read them.
template <typename Options>
std::shared_ptr<Options> Keep(Options options = {}) {
  return std::make_shared<Options>(std::move(options));
}

/// An empty value is most often a variable that nobody has set: no option of a command takes one.
void RefuseEmptyValues(CLI::App& command) {
  const CLI::Validator not_empty([](std::string& text) { return text.empty() ? "must not be empty" : ""; }, "");
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() > 0) option->check(not_empty);
  }
  for (CLI::App* inner : command.get_subcommands([](CLI::App*) { return true; })) RefuseEmptyValues(*inner);
}

/// --seed, --trials, --clips and --joint-map, of every command that makes worlds of scenarios.
template <typename Options>
std::array<CLI::Option*, 4> AddWorldOptions(CLI::App& command, Options& options) {
  return {AddSeed(command, options.seed, "Seed of all worlds (default: the scenario's, else 1)"),
          command.add_option("--trials", options.trials, "Trials per condition (default: the scenario's)")
              ->check(CLI::Range(1, 1000000)),
          command.add_option("--clips", options.clips,
                             "Clips instead of the scenarios' own: builtin:NAME, BVH and glTF files, patterns"),
          command.add_option("--joint-map", options.joint_map,
                             "Which joints of the clips play which roles (etude clip map writes such a file)")};
}

void AddUnsealed(CLI::App& command, Sealing& sealing) {
  command.add_flag_callback(
      "--unsealed", [&sealing] { sealing = Sealing::kIgnored; },
      "Read a run although its folder was changed, and say so");
}

void AddOutsideRules(CLI::App& command, OutsideRules& rules) {
  command.add_flag("!--no-fence", rules.is_fenced, "Run methods outside without a fence, to debug them");
  command.add_flag("--allow-exec", rules.allow_exec, "Run the programs that a manifest, a run or a pack names");
}

void DefineRun(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = Keep<RunOptions>();
  auto shard = Keep<std::string>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("run", "Run scenarios into a result folder");
  command->add_option("scenarios", options->scenarios, "Scenario files, or folders of them");
  command->add_option("-o,--output", options->output, "Result folder (default: out/<suite>-<seed>)");
  AddJobs(*command, options->jobs);
  const auto world_options = AddWorldOptions(*command, *options);
  CLI::Option* shard_option =
      command->add_option("--shard", *shard, "Run part i of n, as i/n; etude merge makes one run of all parts");
  CLI::Option* overwrite = AddOverwrite(*command, options->overwrite, "Replace a folder that already holds a run");
  CLI::Option* resume =
      command->add_flag("--resume", options->resume, "Go on with the run that the folder holds")->excludes(overwrite);
  AddOutsideRules(*command, options->outside);
  command->add_option("--sync-seconds", options->sync.seconds, "What is done is on the disk after so long at most")
      ->check(NumberWithin(0, 3600, "time in s"))
      ->capture_default_str();
  command->add_option("--sync-mebibytes", options->sync.mebibytes, "… and after so much at most")
      ->check(NumberWithin(0, 1024, "size in MiB"))
      ->capture_default_str();
  auto dry_run = Keep<bool>(false);
  command->add_flag("--dry-run", *dry_run, "Only tell how long it would take, and what differences it could show")
      ->excludes(shard_option, overwrite, resume);
  CLI::Option* from = command->add_option("--from", options->from, "Repeat the run that this manifest.json describes");
  for (CLI::Option* option : world_options) from->excludes(option);
  from->excludes(command->add_option("--library", options->libraries,
                                     "NAME=CLIPS: a library beside the scenarios', every condition once more for it"));
  CLI::Option* streams = command->add_option(
      "--streams", options->streams,
      "Recordings of skeletons in the place of simulated people: files, patterns, folders (docs/streams.md)");
  streams->excludes(from, world_options[2]);
  from->excludes(command->add_option("--labels", options->labels,
                                     "Who did what when in --streams or --clips: a file, or a folder of tag streams"));
  command->callback([=, &action] {
    action = [=] {
      if (options->scenarios.empty() == options->from.empty()) {
        return Complain({{}, "etude run needs scenario files or folders, or --from a manifest.json (one of the two)"});
      }
      if (!shard->empty()) {
        const auto part = ParseShard(*shard);
        if (!part) return Complain({{}, "--shard: " + part.error().message});
        options->shard = *part;
      }
      return *dry_run ? DryRunCommand(*options) : RunCommand(*options);
    };
  });
}

void DefineMerge(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = Keep<MergeOptions>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("merge", "Make one run of its shards");
  command->add_option("folders", options->folders, "The folders of all shards, in any order")->required();
  command->add_option("-o,--output", options->output, "Result folder")->required();
  AddOverwrite(*command, options->overwrite, "Replace a folder that already holds a run");
  command->callback([=, &action] { action = [=] { return MergeCommand(*options); }; });
}

void DefineReport(CLI::App& app, Action& action) {
  auto folder = Keep<std::string>();
  auto no_video = Keep<bool>(false);
  auto whole_sessions = Keep<bool>(false);
  CLI::App* command = app.add_subcommand("report", "Write the page, tables, JUnit and video of a run");
  command->add_option("folder", *folder, "A result folder")->required();
  command->add_flag("--no-video", *no_video, "Leave the video out");
  command->add_flag("--whole-sessions", *whole_sessions, "Film coached sessions whole, not around a correction");
  auto real = Keep<std::vector<std::string>>();
  command->add_option("--real", *real,
                      "Beside it, captures of real films: files that `etude capture --distances` wrote");
  auto sealing = Keep<Sealing>();
  AddUnsealed(*command, *sealing);
  command->callback([=, &action] {
    action = [=] {
      return ReportCommand(*folder, *real, {.pictures = !*no_video, .whole_sessions = *whole_sessions}, *sealing);
    };
  });
}

void DefineRows(CLI::App& app, Action& action) {
  auto folder = Keep<std::string>(), file = Keep<std::string>();
  CLI::App* command = app.add_subcommand("rows", "The rows of a run as lines of text, as cells.jsonl has them");
  command->add_option("folder", *folder, "A result folder, also one of columns")->required();
  command->add_option("-o,--output", *file, "Into this file (default: to standard output)");
  auto sealing = Keep<Sealing>();
  AddUnsealed(*command, *sealing);
  auto overwrite = Keep<bool>(false);
  AddOverwrite(*command, *overwrite);
  command->callback([=, &action] { action = [=] { return RowsCommand(*folder, *file, *overwrite, *sealing); }; });
}

void DefineReplay(CLI::App& app, Action& action) {
  auto options = Keep<ReplayCommandOptions>();
  CLI::App* command = app.add_subcommand("replay", "Run cells again and compare them stage by stage");
  command->add_option("target", options->target, "A result folder, or a file that --pack has written")->required();
  CLI::Option* cell = command->add_option("--cell", options->cells, "These cells, as cells.jsonl names them");
  command->add_option("--sample", options->sample, "This many cells, drawn by the run's seed (default: all)")
      ->check(CLI::Range(1, 10'000'000))
      ->excludes(cell);
  AddUnsealed(*command, options->sealing);
  AddOutsideRules(*command, options->outside);
  command->add_option("--pack", options->pack_file, "Write the cell, with its scenario and clips, into this one file");
  AddOverwrite(*command, options->overwrite);
  AddJobs(*command, options->jobs);
  command->callback([=, &action] { action = [=] { return ReplayCommand(*options); }; });
}

void DefineGate(CLI::App& app, Action& action) {
  auto options = Keep<GateOptions>();
  CLI::App* command = app.add_subcommand("gate", "Pass or fail a run, for a CI server");
  command->add_option("folder", options->target, "A result folder (with --self-test: a scenario file, or nothing)");
  CLI::Option* baseline = command->add_option("--baseline", options->baseline, "What the run is held against");
  command->add_flag("--update", options->update, "Write the baseline from this run, and show what moved")
      ->needs(baseline);
  CLI::Option* self_test =
      command->add_flag("--self-test", options->self_test, "Measure the gate's own false alarms and power")
          ->excludes(baseline);
  command->add_flag("--verdicts", options->verdicts, "Self-test: of the verdicts beyond a run's worlds instead")
      ->needs(self_test);
  command->add_option("--repetitions", options->repetitions, "Self-test: pairs of seeds, or samples of each design")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str()
      ->needs(self_test);
  command->add_option("--trials", options->trials, "Self-test: worlds per condition (default: the scenario's)")
      ->check(CLI::Range(1, 1000000))
      ->needs(self_test);
  AddUnsealed(*command, options->sealing);
  command->callback([=, &action] {
    action = [=] {
      if (options->target.empty() && !options->self_test) return Complain({{}, "etude gate needs a result folder"});
      return GateCommand(*options);
    };
  });
}

void DefineCompare(CLI::App& app, Action& action) {
  auto a = Keep<std::string>(), b = Keep<std::string>();
  CLI::App* command = app.add_subcommand("compare", "What differs between two runs of the same worlds");
  command->add_option("a", *a, "A result folder")->required();
  command->add_option("b", *b, "Another")->required();
  auto sealing = Keep<Sealing>();
  AddUnsealed(*command, *sealing);
  command->callback([=, &action] { action = [=] { return CompareCommand(*a, *b, *sealing); }; });
}

void DefineExport(CLI::App& app, Action& action) {
  auto options = Keep<ExportOptions>();
  options->program_version = ETUDE_VERSION;
  CLI::App* command = app.add_subcommand("export", "Write the problems of scenarios as files, the truth apart");
  command->add_option("scenarios", options->scenarios, "Scenario files, or folders of them")->required();
  command->add_option("-o,--output", options->output, "Folder of the data set")->required();
  command->add_flag("--films", options->films, "Each camera's take as an MP4, too, beside its pictures");
  AddWorldOptions(*command, *options);
  command->callback([=, &action] { action = [=] { return ExportCommand(*options); }; });
}

void DefineScore(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = Keep<ScoreOptions>();
  options->program_version = ETUDE_VERSION;
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("score", "Score a folder of answers into a result folder");
  command->add_option("target", options->target, "An exported data set, or its scenario files")->required();
  command->add_option("predictions", options->predictions, "Folder of answers")->required();
  command->add_option("-o,--output", options->output, "Result folder")->required();
  command->add_option("--name", options->name, "What to call the method")->capture_default_str();
  AddOutsideRules(*command, options->outside);
  command->add_flag("--alone", options->alone, "Do not run the scenarios' own methods beside it");
  command->add_flag("--allow-missing", options->allow_missing, "A world without answer is a failed cell");
  AddJobs(*command, options->jobs);
  AddWorldOptions(*command, *options);
  command->callback([=, &action] { action = [=] { return ScoreCommand(*options); }; });
}

void DefineCheckMethod(CLI::App& app, Action& action) {
  struct Options {
    std::vector<std::string> command;
    std::string task, seat;
    double time_s = 10, memory_mb = 4096;
    bool is_fenced = true;
  };
  auto options = Keep<Options>();
  CLI::App* command = app.add_subcommand("check-method", "Test whether a program speaks the protocol of methods");
  command->add_option("command", options->command, "The program and its arguments, after --")->required();
  std::vector<std::string> tasks, seats;
  for (const TaskKind& kind : AllTaskKinds()) {
    tasks.push_back(kind.name);
    if (!kind.seats.empty()) seats.push_back(fmt::format("of task {}: {}", kind.name, Join(kind.seats)));
  }
  command->add_option("--task", options->task, "One of: " + Join(tasks))->required();
  command->add_option("--seat", options->seat, "The program's place in a loop: " + Join(seats, "; "));
  command->add_option("--time", options->time_s, "Seconds per problem, or per step of a session")
      ->check(NumberWithin(0.001, 1e6, "time in seconds"))
      ->capture_default_str();
  command->add_option("--memory", options->memory_mb, "MB of memory")
      ->check(NumberWithin(1, 1e6, "size in MB"))
      ->capture_default_str();
  command->add_flag("!--no-fence", options->is_fenced, "Run it without a fence, to debug it");
  command->callback([=, &action] {
    action = [=] {
      return CheckMethodCommand({.command = options->command,
                                 .task = options->task,
                                 .time_s = options->time_s,
                                 .memory_mb = options->memory_mb},
                                options->seat, options->is_fenced);
    };
  });
}

void DefineList(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("list", "List what a scenario can name");
  command->require_subcommand(1);
  const auto list = [&](const char* name, const char* help, Listing what) {
    command->add_subcommand(name, help)->callback([=, &action] { action = [=] { return ListCommand(what, ""); }; });
  };
  list("methods", "Tasks, what their methods are made of, and solvers", Listing::kMethods);
  list("clips", "Built-in clips", Listing::kClips);
  list("recordings", "The page docs/recordings.md: what recordings hold beside motions", Listing::kRecordings);
  auto json = Keep<bool>(false), markdown = Keep<bool>(false);
  CLI::App* metrics = command->add_subcommand("metrics", "Metrics with their definitions");
  CLI::Option* as_json = metrics->add_flag("--json", *json, "Everything, with the test vectors, for other programs");
  metrics->add_flag("--markdown", *markdown, "The page docs/metrics.md")->excludes(as_json);
  metrics->callback([=, &action] {
    const MetricsFormat format = *json       ? MetricsFormat::kJson
                                 : *markdown ? MetricsFormat::kMarkdown
                                             : MetricsFormat::kTable;
    action = [=] { return ListMetricsCommand(format); };
  });
  auto as_page = Keep<bool>(false), as_schema = Keep<bool>(false);
  CLI::App* keys = command->add_subcommand("keys", "Every key of a scenario file");
  CLI::Option* page = keys->add_flag("--markdown", *as_page, "The page docs/keys.md");
  keys->add_flag("--schema", *as_schema, "The JSON Schema docs/schemas/scenario.schema.json, for editors")
      ->excludes(page);
  keys->callback([=, &action] {
    const KeysFormat format = *as_schema ? KeysFormat::kSchema : *as_page ? KeysFormat::kMarkdown : KeysFormat::kText;
    action = [=] { return ListKeysCommand(format); };
  });
  auto folder = Keep<std::string>("scenarios/quick");
  CLI::App* scenarios = command->add_subcommand("scenarios", "Scenarios of a folder");
  scenarios->add_option("folder", *folder, "Folder of scenarios")->capture_default_str();
  scenarios->callback([=, &action] { action = [=] { return ListCommand(Listing::kScenarios, *folder); }; });
}

void DefineCrowd(CLI::App& app, Action& action) {
  auto options = Keep<CrowdCommandOptions>();
  CLI::App* command = app.add_subcommand("crowd", "Follow a crowd's motions at once, and film it");
  command->add_option("--characters", options->crowd.characters, "How many, each after a motion of its own")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "How long")
      ->check(NumberWithin(0.01, 60, "time in s"))
      ->capture_default_str();
  command->add_option("--rate", options->crowd.rate_hz, "Frames per second")
      ->check(NumberWithin(1, 1000, "rate in Hz"))
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Of gauss-newton, at most, for a character's frame")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  AddSeed(*command, options->crowd.seed, "Of the motions' dice");
  command->add_flag("--float", options->in_float, "Batches of floats, not of doubles");
  command->add_option("-o,--output", options->output, "A film of the crowd (.mp4)");
  AddOverwrite(*command, options->overwrite);
  command->callback([=, &action] { action = [=] { return CrowdCommand(*options); }; });
}

}  // namespace

void DefineCommands(CLI::App& app, const std::string& command_line, Action& action) {
  app.require_subcommand(1);
  DefineRun(app, command_line, action);
  DefineMerge(app, command_line, action);
  DefineReport(app, action);
  DefineRows(app, action);
  DefineReplay(app, action);
  DefineGate(app, action);
  DefineCompare(app, action);
  DefineExport(app, action);
  DefineScore(app, command_line, action);
  DefineCheckMethod(app, action);
  DefineList(app, action);
  DefineClip(app, action);
  DefineBridge(app, action);
  DefineTrain(app, action);
  DefineTeach(app, action);
  DefineRecognise(app, action);
  DefineSensor(app, action);
  DefineCalibrate(app, action);
  DefineCapture(app, action);
  DefineCoach(app, action);
  DefineCrowd(app, action);
  CLI::App* worker = app.add_subcommand("worker", "What the program starts for itself");
  worker->group("");  // hidden
  worker->callback([&action] { action = [] { return RunWorker(std::cin, std::cout); }; });
  RefuseEmptyValues(app);
}

}  // namespace etude
