#include "bench/run/finish.h"

#include <nlohmann/json.hpp>

#include "bench/files/files.h"
#include "bench/files/json.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/run/sum_up.h"
#include "bench/scenario/study_of.h"

namespace etude {

namespace fs = std::filesystem;

Result<bool> FinishRun(const fs::path& folder, const Plan& plan, CellTable& cells, const Json& host, int jobs,
                       const std::function<bool(std::size_t rows)>& goes_on) {
  constexpr std::size_t kRowsBetweenReports = 4096;
  std::vector<Study> studies;
  for (const PreparedScenario& prepared : plan.scenarios()) studies.push_back(StudyOf(prepared.scenario()));
  ASSIGN_OR_RETURN(auto results, ResultWriter::Begin(folder, studies));
  std::vector<ScenarioSummary> summaries;
  std::size_t cell = 0;
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const Study& study = studies[s];
    const std::size_t end =
        cell + study.conditions.size() * static_cast<std::size_t>(study.trials) * study.methods.size();
    ScenarioTable table(study);
    for (; cell < end; ++cell) {
      if (cell % kRowsBetweenReports == 0 && !goes_on(cell)) return false;
      ASSIGN_OR_RETURN(const auto finished, cells.Read(cell, plan));
      table.Add(finished.row);
      RETURN_IF_ERROR(results.Add(finished.row, finished.usage));
    }
    ASSIGN_OR_RETURN(auto summary, SumUp(study, table, plan.scenarios()[s].setup().seed, jobs));
    summaries.push_back(std::move(summary));
  }
  if (!goes_on(cell)) return false;
  RETURN_IF_ERROR(results.Finish(summaries));
  RETURN_IF_ERROR(SaveJson(folder / "host.json", host));
  // The journal is the only other place that knows the results: it goes when all of them are on the disk.
  RETURN_IF_ERROR(SealRun(folder));
  RETURN_IF_ERROR(SyncTree(folder));
  RETURN_IF_ERROR(SyncPathTo(folder));
  std::error_code error;
  fs::remove(folder / kJournalFile, error);
  if (error) return Fail({(folder / kJournalFile).string(), 0, 0}, "cannot be removed: {}", error.message());
  RETURN_IF_ERROR(SyncFolder(folder));
  return true;
}

}  // namespace etude
