#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>

#include "bench/run/worker.h"
#include "cli/commands.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr const char* kAbout =
    "Etude: a deterministic benchmark for interactive human motion.\n\n"
    "Synthesizes what sensors would have seen of a motion, replays it through two complete pipelines\n"
    "(a Kinect-like dance coach; a two-camera markerless capture) and measures transition smoothness,\n"
    "detection accuracy and IK convergence, fixed against adaptive weights.\n";

constexpr const char* kExamples =
    "\nTry:\n"
    "  etude run scenarios/quick                      the quick suite, into out/quick-1\n"
    "  etude run scenarios/quick --clips '~/mocap/*.bvh'   on your own motion capture\n"
    "  etude report out/quick-1                       a page, tables, JUnit and a video of it\n"
    "  etude list methods                             what a scenario can name\n\n"
    "Exit codes: 0 fine, 1 no cell was ok, 2 bad input (nothing is written), 130 interrupted.";

/// The options and subcommands that could have been meant at this point of the command line.
std::vector<std::string> KnownWords(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); })) {
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return known;
}

int ComplainOfArguments(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  // What nobody took explains a failure better than what is missing for want of it.
  const std::vector<std::string> extras = app.remaining(true);
  std::string message = error.what();
  if (!extras.empty()) {
    message =
        UnknownName(extras.front().starts_with("-") ? "option" : "argument", extras.front(), KnownWords(*command));
  }
  return Complain(Error{{},
                        fmt::format("{} (etude {}{}--help explains)", message,
                                    command == &app ? "" : command->get_name(), command == &app ? "" : " ")});
}

/// A standard stream that was closed by whoever started us would lend its number to the next file opened,
/// and what is printed would land in there.
void OpenStandardStreams() {
  for (int descriptor = ::open("/dev/null", O_RDWR); descriptor >= 0; descriptor = ::dup(descriptor)) {
    if (descriptor <= STDERR_FILENO) continue;
    ::close(descriptor);
    break;
  }
}

int Main(int argc, char** argv) {
  CLI::App app(kAbout, "etude");
  app.footer(kExamples);
  app.set_version_flag("--version", ETUDE_VERSION);
  app.require_subcommand(1);

  RunOptions run;
  run.program_version = ETUDE_VERSION;
  for (int i = 0; i < argc; ++i) run.command_line += (i == 0 ? "etude" : std::string(" ") + argv[i]);
  CLI::App* run_command = app.add_subcommand("run", "Run scenarios into a result folder");
  run_command->add_option("scenarios", run.scenarios, "Scenario files, or folders of them")->required();
  run_command->add_option("-o,--output", run.output, "Result folder (default: out/<suite>-<seed>)");
  run_command->add_option("-j,--jobs", run.jobs, "Worker processes (default: one per processor)")
      ->check(CLI::Range(1, 1024));
  run_command->add_option("--seed", run.seed, "Seed of all worlds (default: the scenario's, else 1)")
      ->check(CLI::Range(0.0, 9007199254740992.0));
  run_command->add_option("--trials", run.trials, "Trials per condition (default: the scenario's)")
      ->check(CLI::Range(1, 1000000));
  run_command->add_option("--clips", run.clips, "Clips instead of the scenarios' own: builtin:NAME, files, patterns");
  run_command->add_flag("--overwrite", run.overwrite, "Replace a folder that already holds a run");

  std::string report_folder;
  bool no_video = false;
  CLI::App* report_command = app.add_subcommand("report", "Write the page, tables, JUnit and video of a run");
  report_command->add_option("folder", report_folder, "A result folder")->required();
  report_command->add_flag("--no-video", no_video, "Leave the video out");

  CLI::App* list_command = app.add_subcommand("list", "List what a scenario can name");
  list_command->require_subcommand(1);
  CLI::App* list_methods = list_command->add_subcommand("methods", "Tasks, and what their methods are made of");
  CLI::App* list_metrics = list_command->add_subcommand("metrics", "Metrics with their definitions");
  CLI::App* list_clips = list_command->add_subcommand("clips", "Built-in clips");
  CLI::App* list_scenarios = list_command->add_subcommand("scenarios", "Scenarios of a folder");
  std::string scenario_folder = "scenarios/quick";
  list_scenarios->add_option("folder", scenario_folder, "Folder of scenarios")->capture_default_str();

  CLI::App* worker_command = app.add_subcommand("worker", "What `etude run` starts for itself");
  worker_command->group("");  // hidden

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return ComplainOfArguments(app, error);
  }
  if (*worker_command) return RunWorker(std::cin, std::cout);
  if (*run_command) return RunCommand(run);
  if (*report_command) return ReportCommand(report_folder, !no_video);
  if (*list_methods) return ListCommand(Listing::kMethods, "");
  if (*list_metrics) return ListCommand(Listing::kMetrics, "");
  if (*list_clips) return ListCommand(Listing::kClips, "");
  return ListCommand(Listing::kScenarios, scenario_folder);
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  etude::OpenStandardStreams();
  try {
    const int code = etude::Main(argc, argv);
    if (std::fflush(stdout) == 0) return code;
    return etude::Complain({{"standard output", 0, 0}, std::strerror(errno)});
  } catch (const std::exception& error) {  // out of memory, or an output that takes nothing more
    return etude::Complain({{}, error.what()});
  }
}
