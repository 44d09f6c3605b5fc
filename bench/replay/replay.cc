#include "bench/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/run/manifest.h"
#include "bench/run/supervisor.h"
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
  std::vector<CellCheck> list;
  for (auto& [cell, check] : checks) list.push_back(std::move(check));
  return list;
}

}  // namespace etude
