#include "bench/replay/replay.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "bench/finished_runs/finished_runs.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "bench/run/manifest.h"
#include "bench/run/sum_up.h"
#include "bench/run/supervisor.h"
#include "bench/statistics/scenario_table.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr const char* kAbsent = "nothing";

std::string TextOf(const Row& row, const std::string& metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value ? fmt::format("{}", *value.value) : "null (" + value.null_reason + ")";
  }
  return kAbsent;
}

std::string DigestOf(const Row& row, const std::string& stage) {
  for (const auto& [name, digest] : row.result.digests) {
    if (name == stage) return digest;
  }
  return kAbsent;
}

namespace fs = std::filesystem;

/// The numbers of the wanted cells, ascending.
Result<std::set<std::size_t>> ChooseCells(const ReplayOptions& options, const RunData& run,
                                          const PreparedRun& prepared) {
  const std::optional<ScoredMethod>& scored = prepared.suite.scored;
  std::set<std::pair<std::string, std::string>> left_out;  // scenarios and methods
  for (const PreparedScenario& one : prepared.scenarios) {
    for (const MethodEntry& method : one.scenario().methods) {
      const bool is_left_out = scored && method.name == scored->name;
      const bool asks = !method.exec.empty() || !one.scenario().outside_metrics.empty();
      if (is_left_out || (options.without_programs && asks)) {
        left_out.emplace(one.scenario().name, method.name);
      }
    }
  }
  const auto was_run = [&](const Row& row) { return !left_out.contains({row.scenario, row.method}); };
  std::set<std::size_t> chosen;
  for (const std::string& wanted : options.cells) {
    const auto place = FindRow(run, wanted);
    if (!place) {
      std::vector<std::string> known;
      for (const Row& other : run.rows) known.push_back(other.Id());
      const std::string nearest = NearestName(wanted, known);
      return Fail({options.folder, 0, 0}, "holds no cell '{}'{}", wanted,
                  nearest.empty() ? ", such as '" + known.front() + "'" : "; did you mean '" + nearest + "'?");
    }
    if (!was_run(RowAt(run, *place))) {
      return Fail({options.folder, 0, 0}, "'{}' is an answer that was scored, not run", wanted);
    }
    chosen.insert(*place);
  }
  if (!options.cells.empty()) return chosen;
  // Selection sampling (Knuth, volume 2, algorithm S): every set of `count` cells is as likely.
  std::size_t left = 0;
  ForEachRow(run, [&](const Row& row, std::size_t) { left += was_run(row) ? 1 : 0; });
  const std::size_t count = options.sample == 0 ? left : std::min(options.sample, left);
  RandomStream dice({.suite_seed = run.seed, .scenario = "replay", .trial = 0}, "sample");
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (chosen.size() == count) return;
    if (was_run(row) && dice.IndexBelow(left--) < count - chosen.size()) chosen.insert(place);
  });
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (options.recorded_too && was_run(row) && IsRecorded(prepared, row)) chosen.insert(place);
  });
  return chosen;
}

std::vector<Order> OrdersOf(const Plan& plan, const std::set<std::size_t>& cells) {
  std::vector<bool> done(plan.cell_count(), true);
  for (std::size_t cell : cells) done[cell] = false;
  return plan.OrdersFor(Shard{}, done);
}

/// The curves of a row, which its line does not hold.
std::vector<Series> SeriesOf(const RunData& run, const std::string& cell, std::size_t place) {
  if (run.source) return run.source->SeriesOf(place);
  const auto found = std::ranges::find(run.series, cell, &CellSeries::cell);
  return found == run.series.end() ? std::vector<Series>() : found->series;
}

/// The digest of what a file holds, or of what would stand there.
std::string Fingerprint(std::string_view text) { return Digest().Add(text).Hex(); }

/// Compares what a row keeps in files of their own.
Result<void> CompareKept(const fs::path& folder, const RunData& run, std::size_t place, const Row& now,
                         CellCheck& check) {
  ASSIGN_OR_RETURN(const auto curves_then, WriteJson(EncodeSeries(SeriesOf(run, check.cell, place))));
  ASSIGN_OR_RETURN(const auto curves_now, WriteJson(EncodeSeries(now.result.series)));
  std::string recording_then = kAbsent, recording_now = kAbsent;
  std::error_code none;
  if (const fs::path file = RecordingFile(folder, check.cell); fs::exists(file, none)) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    recording_then = Fingerprint(text);
  }
  if (now.result.recording) {
    ASSIGN_OR_RETURN(const auto json, EncodeRecording(*now.result.recording));
    ASSIGN_OR_RETURN(const auto text, WriteJson(json));
    recording_now = Fingerprint(text + "\n");
  }
  if (curves_then != curves_now) {
    check = {check.cell, false, "curves", Fingerprint(curves_then), Fingerprint(curves_now)};
  } else if (recording_then != recording_now) {
    check = {check.cell, false, "recording", recording_then, recording_now};
  }
  return {};
}

/// Returns what the line of a row holds.
Row WithoutFiles(Row row) {
  row.result.series.clear();
  row.result.recording.reset();
  return row;
}

}  // namespace

bool IsRecorded(const PreparedRun& run, const Row& row) {
  return std::ranges::any_of(run.scenarios, [&](const PreparedScenario& one) {
    return one.scenario().name == row.scenario && one.scenario().recordings.KeepsTrial(row.trial);
  });
}

CellCheck CompareRows(const Row& then, const Row& now) {
  CellCheck check{.cell = then.Id(), .same = true, .stage = "", .then = "", .now = ""};
  const auto differ = [&](const std::string& stage, const std::string& was, const std::string& is) {
    if (check.same && was != is) check = {check.cell, false, stage, was, is};
  };
  // In the order of the pipeline: the first difference is the culprit, later ones only follow from it.
  for (const Row* row : {&then, &now}) {
    for (const auto& [stage, digest] : row->result.digests) differ(stage, DigestOf(then, stage), DigestOf(now, stage));
  }
  differ("status", std::string(StatusName(then.result.status)), std::string(StatusName(now.result.status)));
  differ("reason", then.result.reason, now.result.reason);
  for (const Row* row : {&then, &now}) {
    for (const MetricValue& metric : row->result.metrics) {
      differ(metric.id, TextOf(then, metric.id), TextOf(now, metric.id));
    }
  }
  return check;
}

Result<std::vector<CellCheck>> ReplayRun(const ReplayOptions& options) {
  ASSIGN_OR_RETURN(const auto run, LoadRun(options.folder, options.sealing));
  ASSIGN_OR_RETURN(const auto prepared, PrepareRun(fs::path(options.folder) / "manifest.json", options.key));
  const Plan plan(prepared.scenarios);
  if (CountRows(run) != plan.cell_count()) {
    return Fail({options.folder, 0, 0}, "has {} rows; its manifest makes {}", CountRows(run), plan.cell_count());
  }
  ASSIGN_OR_RETURN(const auto chosen, ChooseCells(options, run, prepared));
  if (!options.without_programs) RETURN_IF_ERROR(CheckPrograms(options.folder, prepared.scenarios, options.outside));
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(prepared.scenarios, options.outside, options.folder, options.key));
  // A failure's reason quotes a program's last words, which are kept only where there is a place for them.
  std::optional<TemporaryFolder> errors;
  if (!ProgramsOf(prepared.scenarios).empty()) {
    ASSIGN_OR_RETURN(errors, TemporaryFolder::Make("replay"));
  }
  const std::string said = errors ? errors->path().string() : "";
  std::map<std::size_t, CellCheck> checks;
  if (options.on_progress) options.on_progress(0, chosen.size());
  const auto whole = RunOrders(
      prepared.suite, plan, OrdersOf(plan, chosen),
      {.program = ThisProgram(), .error_folder = said, .fence = fence, .jobs = options.jobs, .stop = options.stop},
      [&](const DeliveredCell& cell) -> Result<void> {
        ASSIGN_OR_RETURN(const auto finished, cell.Read(plan));
        const std::size_t place = cell.head.cell;
        CellCheck& check = checks[place] = CompareRows(RowAt(run, place), finished.row);
        if (check.same) RETURN_IF_ERROR(CompareKept(options.folder, run, place, finished.row, check));
        if (!options.cells.empty()) check.row = WithoutFiles(finished.row);
        if (options.on_progress) options.on_progress(checks.size(), chosen.size());
        return {};
      });
  if (!whole) return tl::unexpected(whole.error());
  RETURN_IF_ERROR(CheckStillThere(options.folder, run));
  std::vector<CellCheck> list;
  for (auto& [cell, check] : checks) list.push_back(std::move(check));
  return list;
}

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
  RETURN_IF_ERROR(CheckStillThere(folder, run.data));
  return all;
}

}  // namespace etude
