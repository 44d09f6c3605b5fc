#include "bench/run/finish.h"

#include <nlohmann/json.hpp>

#include "bench/files/durable.h"
#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/scenario/study_of.h"
#include "bench/statistics/summary.h"

namespace etude {

namespace fs = std::filesystem;

Result<void> SaveJson(const fs::path& path, const Json& json) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n");
}

Result<void> FinishRun(const fs::path& folder, const Plan& plan, CellTable& cells, const Json& host) {
  ASSIGN_OR_RETURN(auto results, ResultWriter::Begin(folder));
  ASSIGN_OR_RETURN(auto timings, AtomicFile::Begin(folder / "timings.jsonl"));
  std::vector<ScenarioSummary> summaries;
  std::size_t cell = 0;
  for (const PreparedScenario& prepared : plan.scenarios()) {
    const Scenario& scenario = prepared.scenario();
    const std::size_t count =
        scenario.conditions.size() * static_cast<std::size_t>(scenario.trials) * scenario.methods.size();
    const Study study = StudyOf(scenario);
    ScenarioTable table(study);
    for (const std::size_t end = cell + count; cell < end; ++cell) {
      ASSIGN_OR_RETURN(const auto finished, cells.Read(cell, plan));
      table.Add(finished.row);
      RETURN_IF_ERROR(results.Add(finished.row));
      ASSIGN_OR_RETURN(const auto line, WriteJson(EncodeUsage(finished.row.Id(), finished.usage)));
      RETURN_IF_ERROR(timings.Write(line + "\n"));
    }
    summaries.push_back(Summarise(study, table, prepared.setup().seed));
  }
  RETURN_IF_ERROR(results.Finish(summaries));
  RETURN_IF_ERROR(timings.Finish());
  RETURN_IF_ERROR(SaveJson(folder / "host.json", host));
  // The journal is the only other place that knows the results: it goes when all of them are on the disk.
  RETURN_IF_ERROR(SealRun(folder));
  RETURN_IF_ERROR(SyncTree(folder));
  RETURN_IF_ERROR(SyncPathTo(folder));
  std::error_code error;
  fs::remove(folder / kJournalFile, error);
  if (error) return Fail({(folder / kJournalFile).string(), 0, 0}, "cannot be removed: {}", error.message());
  return SyncFolder(folder);
}

}  // namespace etude
