#include "bench/run/finish.h"

#include <nlohmann/json.hpp>

#include "bench/files/durable.h"
#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/run/cell_json.h"
#include "bench/scenario/study_of.h"
#include "bench/statistics/summary.h"

namespace etude {

namespace fs = std::filesystem;

Result<void> SaveJson(const fs::path& path, const Json& json) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n");
}

Result<void> FinishRun(const fs::path& folder, const Plan& plan, CellTable cells, const Json& host) {
  std::vector<Row> rows;
  std::string timings;
  for (std::optional<FinishedCell>& cell : cells) {
    ASSIGN_OR_RETURN(const auto line, WriteJson(EncodeUsage(cell->row.Id(), cell->usage)));
    timings += line + "\n";
    rows.push_back(std::move(cell->row));
  }
  std::vector<ScenarioSummary> summaries;
  std::size_t at = 0;
  for (const PreparedScenario& prepared : plan.scenarios()) {
    const Scenario& scenario = prepared.scenario();
    const std::size_t count =
        scenario.conditions.size() * static_cast<std::size_t>(scenario.trials) * scenario.methods.size();
    const Study study = StudyOf(scenario);
    summaries.push_back(Summarise(study, Tabulate(study, std::span(rows).subspan(at, count)), prepared.setup().seed));
    at += count;
  }
  RETURN_IF_ERROR(SaveResults(folder, rows, summaries));
  RETURN_IF_ERROR(WriteFileAtomically(folder / "timings.jsonl", timings));
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
