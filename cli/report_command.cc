#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <span>

#include "bench/results/folder.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/machine.h"
#include "engine/base/names.h"
#include "io/drawing/numbers.h"
#include "io/files/files.h"
#include "reports/blind_page.h"
#include "reports/report.h"

namespace etude {
namespace {

Result<std::vector<RealTake>> ReadRealTakes(const std::vector<std::string>& files) {
  std::vector<RealTake> takes;
  for (const std::string& file : files) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    ASSIGN_OR_RETURN(takes.emplace_back(), ReadRealTake(text, file));
  }
  return takes;
}

Result<int> ReportCommand(const std::string& folder, const std::vector<std::string>& real, ReportOptions options,
                          Sealing sealing, int jobs) {
  ASSIGN_OR_RETURN(options.real, ReadRealTakes(real));
  ASSIGN_OR_RETURN(const auto run, LoadRun(folder, sealing));
  TellUnsealed(run.unsealed);
  RETURN_IF_ERROR(CheckRowsAgainstSummary(folder, run));
  const Interrupt interrupt;
  options.watch = WatchFilms(interrupt, jobs);
  ASSIGN_OR_RETURN(const bool is_whole, WriteReport(run, folder, options));
  if (!is_whole) return TellStopped({{folder, 0, 0}, "stopped; Etude wrote the tables, but not the page"});
  ASSIGN_OR_RETURN(const int code, UnlessReplaced(folder, run, kSuccess));
  if (code == kSuccess) TellWritten(folder + "/report/index.html");
  return code;
}

/// Fails if `methods` names a method that no transition scenario of the run has, or names a method twice.
Result<void> CheckBlindMethods(const RunData& run, std::span<const std::string> methods) {
  std::vector<std::string> known;
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.task == "transition") known.insert(known.end(), scenario.methods.begin(), scenario.methods.end());
  }
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (auto name = methods.begin(); name != methods.end(); ++name) {
    if (!std::ranges::binary_search(known, *name)) return Fail({"--blind"}, "{}", UnknownName("method", *name, known));
    if (std::find(methods.begin(), name, *name) != name) {
      return Fail({"--blind"}, "found the method '{}' twice; allowed: each method once", *name);
    }
  }
  return {};
}

Result<int> BlindPageCommand(const std::string& folder, BlindOptions options, Sealing sealing, int jobs) {
  ASSIGN_OR_RETURN(const auto run, LoadRun(folder, sealing));
  TellUnsealed(run.unsealed);
  RETURN_IF_ERROR(CheckRowsAgainstSummary(folder, run));
  RETURN_IF_ERROR(CheckBlindMethods(run, options.methods));
  const Interrupt interrupt;
  options.watch = WatchFilms(interrupt, jobs);
  auto trial = MakeBlindTrial(run, options);
  if (!trial) return Fail({folder}, "{}", trial.error().message);
  if (!*trial) return TellStopped();
  const auto& [page_html, key] = **trial;
  // The names of page and key are the digest of the page's content, so no other page's key is overwritten.
  const FilePath page = Inside(folder) / "blind" / (key.page + ".html");
  const FilePath key_file = Inside(folder) / "blind" / (key.page + ".key.json");
  RETURN_IF_ERROR(WriteFileAtomically(key_file, WriteBlindKey(key)));
  RETURN_IF_ERROR(WriteFileAtomically(page, page_html));
  fmt::print(
      "{} of films, from {} recorded worlds; {} worlds were left out, because a method made no transition there. Do "
      "not show the key file to raters.\n",
      Plural(static_cast<long long>(key.pairs.size()), "pair"), key.worlds, key.left_out);
  TellWritten(page.string());
  TellWritten(key_file.string());
  return kSuccess;
}

Result<int> RowsCommand(const std::string& folder, const std::string& file, bool overwrite, Sealing sealing) {
  if (file.empty()) {
    if (OutputWasClosed()) return Fail({"standard output"}, "was closed; use -o to write the rows into a file");
    RETURN_IF_ERROR(WriteRows(folder, sealing, [](std::string_view line) -> Result<void> {
      if (std::fwrite(line.data(), 1, line.size(), stdout) == line.size()) return {};
      return CannotWrite("standard output", "cannot be written", errno);
    }));
    return kSuccess;
  }
  RETURN_IF_ERROR(CheckOutput(file, overwrite));
  ASSIGN_OR_RETURN(auto out, AtomicFile::Begin(file));
  RETURN_IF_ERROR(WriteRows(folder, sealing, [&](std::string_view line) { return out.Write(line); }));
  RETURN_IF_ERROR(out.Finish());
  TellWritten(file);
  return kSuccess;
}

}  // namespace

void DefineReport(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  auto no_video = std::make_shared<bool>(false);
  auto whole_sessions = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("report", "Write the report of a run: an HTML page, tables, a JUnit file and videos");
  command->add_option("folder", *folder, "A result folder")->required();
  command->add_flag("--no-video", *no_video, "Make no videos");
  command->add_flag("--whole-sessions", *whole_sessions,
                    "Show whole coaching sessions in films, instead of only the time around a correction");
  auto real = std::make_shared<std::vector<std::string>>();
  command->add_option("--real", *real,
                      "Add results of captures of real films, from files that `etude capture --distances` wrote");
  auto sealing = std::make_shared<Sealing>();
  AddUnsealed(*command, *sealing);
  auto jobs = std::make_shared<int>(0);
  AddJobs(*command, *jobs);
  auto blind = std::make_shared<BlindOptions>();
  CLI::Option* methods = command
                             ->add_option("--blind", blind->methods,
                                          "Instead of the report, write two files for a blind test into DIR/blind: a "
                                          "page on which people compare films of transitions by these methods, without "
                                          "knowing the method, and a key file that states the method of each film")
                             ->expected(2, 16)
                             ->excludes("--no-video", "--whole-sessions", "--real");
  command->add_option("--pairs", blind->pairs, "With --blind: the largest number of pairs of films")
      ->needs(methods)
      ->check(NumberWithin(1, 1000, "number of pairs"));
  AddSeed(*command, blind->seed, "With --blind: seed of the random numbers that determine worlds, order and sides")
      ->needs(methods);
  command->callback([=, &action] {
    action = [=] {
      if (!blind->methods.empty()) return Finish(BlindPageCommand(*folder, *blind, *sealing, *jobs));
      return Finish(
          ReportCommand(*folder, *real, {.pictures = !*no_video, .whole_sessions = *whole_sessions}, *sealing, *jobs));
    };
  });
}

void DefineRows(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>(), file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("rows", "Print the rows of a run in the format of cells.jsonl");
  command->add_option("folder", *folder, "A result folder; its results may be stored as rows or as columns")
      ->required();
  command->add_option("-o,--output", *file, "Write into this file (default: standard output)");
  auto sealing = std::make_shared<Sealing>();
  AddUnsealed(*command, *sealing);
  auto overwrite = std::make_shared<bool>(false);
  AddOverwrite(*command, *overwrite);
  command->callback(
      [=, &action] { action = [=] { return Finish(RowsCommand(*folder, *file, *overwrite, *sealing)); }; });
}

}  // namespace etude
