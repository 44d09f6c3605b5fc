#include "reports/report.h"

#include <algorithm>

#include "bench/files/files.h"
#include "bench/recordings/capture_extras.h"
#include "reports/comparison_table.h"
#include "reports/films/media.h"
#include "reports/junit.h"
#include "reports/number_table.h"
#include "reports/page.h"
#include "reports/paper/paper_b_section.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

Result<void> WriteTables(const RunData& run, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    const std::string name = FileNameOf(scenario.name, i);
    auto written = WriteFileAtomically(folder / (name + ".csv"), NumberTableCsv(run, scenario));
    if (!written) return written;
    written = WriteFileAtomically(folder / (name + "-comparisons.csv"), ComparisonTableCsv(scenario));
    if (!written) return written;
    written = WriteFileAtomically(folder / (name + ".tex"), ScenarioLatex(run, scenario));
    if (!written) return written;
    if (const std::string csv = PaperBCsv(run, scenario); !csv.empty()) {
      written = WriteFileAtomically(folder / (name + "-paper-b.csv"), csv);
      if (!written) return written;
    }
  }
  return {};
}

// The motions that captures recovered, for any program that reads BVH.
Result<void> WriteMotions(const RunData& run, const std::filesystem::path& folder) {
  for (const CellRecording& recorded : run.recordings) {
    const auto row = std::ranges::find(run.rows, recorded.cell, &Row::Id);
    if (row == run.rows.end() || row->task != "capture") continue;
    ASSIGN_OR_RETURN(const auto extras, ReadCaptureExtras(recorded.recording.extras_json));
    std::string name = recorded.cell;
    std::ranges::replace(name, '/', '~');
    RETURN_IF_ERROR(WriteFileAtomically(folder / (name + ".bvh"), extras.bvh));
  }
  return {};
}

}  // namespace

Result<bool> WriteReport(const RunData& run, const std::filesystem::path& run_folder, const ReportOptions& options) {
  const std::filesystem::path folder = run_folder / "report";
  // The cheap texts first, so that they are there even when rendering the film fails.
  RETURN_IF_ERROR(WriteFileAtomically(folder / "summary.md", WriteMarkdown(run)));
  RETURN_IF_ERROR(WriteFileAtomically(folder / "junit.xml", WriteJunit(run)));
  RETURN_IF_ERROR(WriteTables(run, folder / "tables"));
  RETURN_IF_ERROR(WriteMotions(run, folder / "motions"));

  Media media;
  if (options.pictures) {
    media = MakeMedia(run, {.films = run_folder / "video", .pictures = folder / "pictures"},
                      {.whole_sessions = options.whole_sessions, .watch = options.watch});
    if (options.watch.IsStopped()) return false;
  } else {
    media.film.why_not = "There is no film: none was asked for.";
  }
  RETURN_IF_ERROR(WriteFileAtomically(folder / "index.html", WritePage(run, media, options.real)));
  return true;
}

}  // namespace etude
