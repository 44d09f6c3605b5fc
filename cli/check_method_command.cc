#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/outside/conformance.h"
#include "bench/outside/outside_method.h"
#include "bench/outside/program_view.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/stream_reading.h"
#include "engine/base/names.h"
#include "engine/teaching/labelled_streams.h"
#include "io/files/files.h"
#include "io/process/child_process.h"
#include "io/streams/load.h"

namespace etude {
namespace {

/// Recordings of people, which the check uses instead of simulated people.
struct RecordedPeople {
  std::vector<std::string> streams;
  std::string labels;  ///< a file of labels; "" = each recording is one move
  StreamArguments reading;
};

/// Loads recordings and labels; returns null if there are none.
Result<std::unique_ptr<LabelledStreams>> LoadPeople(const RecordedPeople& people) {
  if (people.streams.empty()) return nullptr;
  ASSIGN_OR_RETURN(auto loaded, people.reading.Load(people.streams));
  LabelTexts labels;
  if (!people.labels.empty()) {
    ASSIGN_OR_RETURN(const auto files, LabelFiles(people.labels));
    for (const std::string& file : files) {
      ASSIGN_OR_RETURN(labels[file], ReadWholeFile(file));
    }
  }
  for (NamedStream& stream : loaded.streams) stream.motion.reset();  // only the sensed data remain, as in a run
  ASSIGN_OR_RETURN(auto labelled, LabelStreams(std::move(loaded.streams), labels));
  for (const Error& copy : labelled.copies) fmt::print(stderr, "left out: {}\n", ToString(copy));
  return std::make_unique<LabelledStreams>(std::move(labelled));
}

int CheckMethodCommand(OutsideOptions options, const std::string& seat, const RecordedPeople& people, bool is_fenced,
                       bool as_json) {
  AdoptOrphans();
  if (auto named = CheckNames(options.command); !named) return Complain(named.error());
  const auto recordings = LoadPeople(people);
  if (!recordings) return Complain(recordings.error());
  if (is_fenced) options.fence = Fence::Find();
  if (!as_json) {
    fmt::print("fence: {}\nmemory: {}\n", options.fence.description(), options.fence.MemoryDescription());
  }
  Json checks_made = Json::array();
  int checks = 0, passed = 0;
  // Run the checks, and print each check when it ends.
  const auto all_passed = CheckConformance(
      options, seat,
      [&](const ConformanceCheck& check) {
        ++checks;
        passed += check.passed ? 1 : 0;
        checks_made.push_back({{"check", check.name}, {"passed", check.passed}, {"found", check.found}});
        if (as_json) return;
        fmt::print("{}  {}: {}\n", check.passed ? "passed" : "FAILED", check.name, check.found);
        std::fflush(stdout);
      },
      recordings->get());
  // Print the result.
  if (!all_passed) return Complain(all_passed.error());
  if (as_json) {
    const auto printed = PrintFacts("check-method", {{"passed", *all_passed},
                                                     {"fence", options.fence.description()},
                                                     {"memory", options.fence.MemoryDescription()},
                                                     {"checks", std::move(checks_made)}});
    if (!printed) return Complain(printed.error());
    return *all_passed ? kSuccess : kNothingWorked;
  }
  fmt::print("{} of {} checks passed{}\n", passed, checks,
             *all_passed ? "" : "; docs/outside-methods.md describes the protocol");
  return *all_passed ? kSuccess : kNothingWorked;
}

}  // namespace

void DefineCheckMethod(CLI::App& app, Action& action) {
  struct Options {
    std::vector<std::string> command, files;
    std::string task, seat;
    RecordedPeople people;
    double time_s = 10, memory_mb = 4096;
    bool is_fenced = true, as_json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check-method", "Test whether a program correctly implements Etude's protocol for outside methods");
  command->add_option("command", options->command, "The program and the arguments of the program, after `--`")
      ->required();
  // List the allowed tasks and seats (a seat is the program's part in a loop).
  std::vector<std::string> tasks, seats;
  for (const TaskKind& kind : AllTaskKinds()) {
    tasks.push_back(kind.name);
    if (!kind.seats.empty()) seats.push_back(fmt::format("for task {}: {}", kind.name, Join(kind.seats)));
  }
  command->add_option("--task", options->task, "One of: " + Join(tasks))->required();
  command->add_option("--seat", options->seat,
                      "The part of the task's loop that the program replaces (its seat): " + Join(seats, "; "));
  // Define recordings of people, for tasks that can use them.
  CLI::Option* streams =
      command->add_option("--streams", options->people.streams,
                          "Recordings of people from which problems are made, as in `etude run --streams`");
  streams->allow_extra_args(false);
  command
      ->add_option(
          "--labels", options->people.labels,
          "Labels of the recordings (which person performed which move, and when): a file, or a folder of tag streams")
      ->needs(streams);
  AddStreamReading(*command, options->people.reading);
  // Define limits, and the fence.
  command->add_option("--time", options->time_s, "Time limit per problem, or per step of a session, in seconds")
      ->check(NumberWithin(0.001, 1e6, "time in seconds"));
  command->add_option("--memory", options->memory_mb, "Memory limit, in MB")->check(NumberWithin(1, 1e6, "size in MB"));
  command
      ->add_option("--files", options->files,
                   "Files and folders that the program can read inside its sandbox, the fence (default: the program's "
                   "own folder)")
      ->allow_extra_args(false);
  command->add_flag("!--no-fence", options->is_fenced, "Run the program without its sandbox (the fence), to debug it");
  AddJson(*command, options->as_json);
  command->callback([=, &action] {
    action = [=] {
      return CheckMethodCommand({.command = options->command,
                                 .task = options->task,
                                 .time_s = options->time_s,
                                 .memory_mb = options->memory_mb,
                                 .files = options->files,
                                 .by_options = true},
                                options->seat, options->people, options->is_fenced, options->as_json);
    };
  });
}

}  // namespace etude
