#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "bench/results/folder.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/machine.h"
#include "io/files/files.h"
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
  if (!is_whole) return TellStopped({{folder, 0, 0}, "stopped; the tables were written, but not the page"});
  ASSIGN_OR_RETURN(const int code, UnlessReplaced(folder, run, kSuccess));
  if (code == kSuccess) TellWritten(folder + "/report/index.html");
  return code;
}

Result<int> RowsCommand(const std::string& folder, const std::string& file, bool overwrite, Sealing sealing) {
  if (file.empty()) {
    if (OutputWasClosed()) return Fail({"standard output"}, "was closed; -o writes the rows into a file");
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
  CLI::App* command = app.add_subcommand("report", "Write a run's page, tables, JUnit file and video");
  command->add_option("folder", *folder, "A result folder")->required();
  command->add_flag("--no-video", *no_video, "Leave the video out");
  command->add_flag("--whole-sessions", *whole_sessions,
                    "Show whole coached sessions in films, not only the time around a correction");
  auto real = std::make_shared<std::vector<std::string>>();
  command->add_option("--real", *real, "Add results on real films: files that `etude capture --distances` wrote");
  auto sealing = std::make_shared<Sealing>();
  AddUnsealed(*command, *sealing);
  auto jobs = std::make_shared<int>(0);
  AddJobs(*command, *jobs);
  command->callback([=, &action] {
    action = [=] {
      return Finish(
          ReportCommand(*folder, *real, {.pictures = !*no_video, .whole_sessions = *whole_sessions}, *sealing, *jobs));
    };
  });
}

void DefineRows(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>(), file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("rows", "Print the rows of a run as in cells.jsonl");
  command->add_option("folder", *folder, "A result folder, of rows or columns")->required();
  command->add_option("-o,--output", *file, "Write into this file (default: standard output)");
  auto sealing = std::make_shared<Sealing>();
  AddUnsealed(*command, *sealing);
  auto overwrite = std::make_shared<bool>(false);
  AddOverwrite(*command, *overwrite);
  command->callback(
      [=, &action] { action = [=] { return Finish(RowsCommand(*folder, *file, *overwrite, *sealing)); }; });
}

}  // namespace etude
