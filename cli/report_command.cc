#include <cerrno>
#include <cstdio>
#include <cstring>

#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "cli/commands.h"
#include "cli/film_watch.h"
#include "cli/output_file.h"
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

}  // namespace

int ReportCommand(const std::string& folder, const std::vector<std::string>& real, const ReportOptions& given,
                  Sealing sealing) {
  auto takes = ReadRealTakes(real);
  if (!takes) return Complain(takes.error());
  const auto run = LoadRun(folder, sealing);
  if (!run) return Complain(run.error());
  TellUnsealed(*run);
  if (auto whole = CheckRowsAgainstSummary(folder, *run); !whole) return Complain(whole.error());
  const Interrupt interrupt;
  ReportOptions options = given;
  options.watch = WatchFilms(interrupt);
  options.real = std::move(*takes);
  const auto written = WriteReport(*run, folder, options);
  if (!written) return Complain(written.error());
  if (!*written) return TellStopped({{folder, 0, 0}, "stopped; the tables are written, the page is not"});
  TellWritten(folder + "/report/index.html");
  return kSuccess;
}

int RowsCommand(const std::string& folder, const std::string& file, bool overwrite, Sealing sealing) {
  if (file.empty()) {
    const auto written = WriteRows(folder, sealing, [](std::string_view line) -> Result<void> {
      if (std::fwrite(line.data(), 1, line.size(), stdout) == line.size()) return {};
      return Fail({"standard output"}, "cannot be written: {}", std::strerror(errno));
    });
    return written ? kSuccess : Complain(written.error());
  }
  const auto write = [&]() -> Result<void> {
    RETURN_IF_ERROR(CheckOutput(file, overwrite));
    ASSIGN_OR_RETURN(auto out, AtomicFile::Begin(file));
    RETURN_IF_ERROR(WriteRows(folder, sealing, [&](std::string_view line) { return out.Write(line); }));
    return out.Finish();
  };
  if (const auto written = write(); !written) return Complain(written.error());
  TellWritten(file);
  return kSuccess;
}

}  // namespace etude
