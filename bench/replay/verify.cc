#include "bench/replay/verify.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/files/files.h"
#include "bench/finished_runs/finished_runs.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "bench/run/manifest.h"
#include "bench/run/outside_programs.h"
#include "bench/run/sum_up.h"
#include "bench/run/supervisor.h"
#include "bench/statistics/scenario_table.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The summary as the rows make it.
Result<Json> SummaryOf(const FinishedRun& run, int jobs) {
  std::vector<ScenarioSummary> summaries;
  for (const FinishedScenario& scenario : run.scenarios) {
    ScenarioTable table(scenario.study);
    ForEachRow(run.data, [&](const Row& row, std::size_t) { table.Add(row); });
    ASSIGN_OR_RETURN(auto summary, SumUp(scenario.study, table, scenario.seed, jobs));
    summaries.push_back(std::move(summary));
  }
  return EncodeSummaries(summaries);
}

Result<Verified> VerifySummary(const fs::path& folder, const FinishedRun& run, int jobs) {
  Verified verified{fmt::format("summary.json: computed again from {} rows", CountRows(run.data)), {}};
  ASSIGN_OR_RETURN(const auto then, ReadJsonFile(folder / "summary.json"));
  ASSIGN_OR_RETURN(const auto now, SummaryOf(run, jobs));
  ASSIGN_OR_RETURN(const auto text, WriteJson(now));
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / "summary.json"));
  if (found == text + "\n") return verified;
  // What was written rounds nothing, so that it is compared as it reads.
  ASSIGN_OR_RETURN(const auto again, ReadJson(text, "the summary computed again"));
  const auto differences = CompareManifests(then, again);
  verified.differences = {differences.empty() ? "is written otherwise" : InWords(differences)};
  return verified;
}

/// The recordings that no cell of the run would leave.
Result<Verified> VerifyRecordings(const fs::path& folder, const FinishedRun& run, const PreparedRun& prepared) {
  std::set<fs::path> wanted;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    if (IsRecorded(prepared, row)) wanted.insert(RecordingFile(folder, row.Id()).filename());
  });
  Verified verified{"recordings: each belongs to a cell", {}};
  std::error_code none;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder / "recordings", none)) found.push_back(entry.path());
  std::ranges::sort(found);
  for (const fs::path& file : found) {
    if (!wanted.contains(file.filename())) verified.differences.push_back(file.string() + " belongs to no cell");
  }
  return verified;
}

Result<Verified> VerifyCells(const ReplayOptions& options, const PreparedRun& prepared) {
  ASSIGN_OR_RETURN(const auto checks, ReplayRun(options));
  Verified verified{fmt::format("{} cells, the recorded ones among them, run again: {}", checks.size(),
                                "stages, metrics, curves, recordings"),
                    {}};
  for (const CellCheck& check : checks) {
    if (check.same) continue;
    verified.differences.push_back(
        fmt::format("{}: {} was {} and is {}", check.cell, check.stage, check.then, check.now));
  }
  const bool leaves_out = options.without_programs && !ProgramsOf(prepared.scenarios).empty();
  if (leaves_out) verified.what += "; those of programs were not (--allow-exec)";
  return verified;
}

}  // namespace

Result<std::vector<Verified>> VerifyRun(const ReplayOptions& options, bool replays) {
  const fs::path folder = options.folder;
  ASSIGN_OR_RETURN(const auto run, LoadFinishedRun(folder, Sealing::kIgnored));
  std::vector<Verified> all;
  all.push_back({"seal.json: every file is as it was sealed", {}});
  if (!run.data.unsealed.empty()) all.back().differences.push_back(run.data.unsealed);
  all.push_back({"rows: those that the manifest asks for", run.incomplete});
  if (!run.incomplete.empty()) return all;
  ASSIGN_OR_RETURN(all.emplace_back(), VerifySummary(folder, run, WorkerCount(options.jobs)));
  if (!replays) return all;
  ASSIGN_OR_RETURN(const auto prepared, PrepareRun(folder / "manifest.json", options.key));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyRecordings(folder, run, prepared));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyCells(options, prepared));
  return all;
}

}  // namespace etude
