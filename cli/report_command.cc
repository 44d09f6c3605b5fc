#include <fmt/core.h>

#include "bench/results/folder.h"
#include "cli/commands.h"
#include "reports/report.h"

namespace etude {

int ReportCommand(const std::string& folder, const ReportOptions& options, Sealing sealing) {
  const auto run = LoadRun(folder, sealing);
  if (!run) return Complain(run.error());
  TellUnsealed(*run);
  if (auto whole = CheckRowsAgainstSummary(folder, *run); !whole) return Complain(whole.error());
  const auto written = WriteReport(*run, folder, options);
  if (!written) return Complain(written.error());
  fmt::print("{}/report/index.html\n", folder);
  return kSuccess;
}

}  // namespace etude
