#include "bench/replay/replay.h"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bench/results/row_json.h"
#include "bench/run/manifest.h"
#include "bench/run/supervisor.h"
#include "bench/run/used_keys.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "io/files/files.h"
#include "io/files/own_files.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

constexpr const char* kAbsent = "nothing";

std::string TextOf(const Row& row, const std::string& metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value ? fmt::format("{}", *value.value) : "null (" + value.null_reason + ")";
  }
  return kAbsent;
}

std::string StatusText(Status status) { return std::string(StatusName(status)); }

std::string DigestOf(const Row& row, const std::string& stage) {
  for (const auto& [name, digest] : row.result.digests) {
    if (name == stage) return digest;
  }
  return kAbsent;
}

namespace fs = std::filesystem;

std::vector<Order> OrdersOf(const Plan& plan, const std::set<std::size_t>& cells) {
  std::vector<bool> done(plan.cell_count(), true);
  for (std::size_t cell : cells) done[cell] = false;
  return plan.OrdersFor(Shard{}, done);
}

/// The curves of a run, which are stored apart from the rows.
class CurvesOfRun {
 public:
  explicit CurvesOfRun(const RunData& run) : run_(run) {
    for (const CellSeries& one : run.series) held_.emplace(one.cell, &one);
  }
  std::vector<Series> Of(const std::string& cell, std::size_t place) const {
    if (run_.source) return run_.source->SeriesOf(place);
    const auto found = held_.find(cell);
    return found == held_.end() ? std::vector<Series>() : found->second->series;
  }

 private:
  const RunData& run_;
  std::map<std::string_view, const CellSeries*> held_;
};

std::string Fingerprint(std::string_view text) { return Digest().Add(text).Hex(); }

/// Compares the curves and the recording of a cell with those of its second run. Curves and recordings are not stored
/// in the rows, but in separate files.
Result<void> CompareKept(const fs::path& folder, const std::vector<Series>& then, const Row& now, CellCheck& check) {
  ASSIGN_OR_RETURN(const auto curves_then, WriteJson(EncodeSeries(then)));
  ASSIGN_OR_RETURN(const auto curves_now, WriteJson(EncodeSeries(now.result.series)));
  std::string recording_then = kAbsent, recording_now = kAbsent;
  if (const FilePath file = RecordingFile(folder, check.cell); Exists(file)) {
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

/// Returns the row without curves and recording, which are stored in other files.
Row WithoutFiles(Row row) {
  row.result.series.clear();
  row.result.recording.reset();
  return row;
}

}  // namespace

CellCheck CompareIdentity(const Row& then, const Row& now) {
  CellCheck check{.cell = then.Id(), .same = true, .stage = "", .then = "", .now = ""};
  const auto differ = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (check.same && was != is) check = {check.cell, false, what, was, is};
  };
  differ("scenario", then.scenario, now.scenario);
  differ("task", then.task, now.task);
  differ("cell", then.Id(), now.Id());
  differ("clip", then.clip, now.clip);
  differ("units", Join(then.units), Join(now.units));
  return check;
}

CellCheck CompareRows(const Row& then, const Row& now) {
  CellCheck check = CompareIdentity(then, now);  // rows of different cells are not compared further
  const auto differ = [&](const std::string& stage, const std::string& was, const std::string& is) {
    if (check.same && was != is) check = {check.cell, false, stage, was, is};
  };
  // A cell that timed out, crashed or ran out of memory has no digests of stages, so the status is compared first.
  const Status was = then.result.status, is = now.result.status;
  if (DependsOnMachine(was) || DependsOnMachine(is)) differ("status", StatusText(was), StatusText(is));
  // Compare stages in the order of the pipeline, because the first difference causes the later ones.
  for (const Row* row : {&then, &now}) {
    for (const auto& [stage, digest] : row->result.digests) differ(stage, DigestOf(then, stage), DigestOf(now, stage));
  }
  differ("status", StatusText(was), StatusText(is));
  differ("reason", then.result.reason, now.result.reason);
  differ("judged", EncodeJudged(then.result.judged).dump(), EncodeJudged(now.result.judged).dump());
  for (const Row* row : {&then, &now}) {
    for (const MetricValue& metric : row->result.metrics) {
      differ(metric.id, TextOf(then, metric.id), TextOf(now, metric.id));
    }
  }
  return check;
}

Result<void> NoteKey(const std::string& target, const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                     const std::optional<SecretKey>& key) {
  if (!key || suite.seed.IsPlain() || ProgramsOf(scenarios).empty()) return {};
  return NoteRepeat(*key, {"replay", suite.suite, DigestOfRun(EncodeSetup(suite)), {}, target});
}

Result<ReplayOutcome> ReplayRun(const ReplayOptions& options) {
  const FolderBegun begun(options.folder);
  ASSIGN_OR_RETURN(const auto run, LoadRun(options.folder, options.sealing));
  ASSIGN_OR_RETURN(const auto prepared, begun.Tell(PrepareRun(Inside(options.folder) / "manifest.json", options.key)));
  return begun.Tell(ReplayPrepared(options, run, prepared));
}

Result<ReplayOutcome> ReplayPrepared(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared) {
  const Plan plan(prepared.scenarios);
  if (CountRows(run) != plan.cell_count()) {
    return Fail({options.folder, 0, 0}, "contains {} rows, but its manifest describes {} cells", CountRows(run),
                plan.cell_count());
  }
  // Choose the cells, and check that their programs may be run.
  ReplayOutcome outcome;
  ASSIGN_OR_RETURN(outcome.choice, ChooseCells(options, run, prepared));
  const std::set<std::size_t>& chosen = outcome.choice.places;
  if (!options.without_programs) {
    RETURN_IF_ERROR(CheckPrograms(options.folder, prepared.scenarios, options.outside));
    RETURN_IF_ERROR(NoteKey(options.folder, prepared.suite, prepared.scenarios, options.key));
  }
  const auto fenced = options.without_programs ? std::span<const PreparedScenario>() : prepared.scenarios;
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(fenced, options.outside, options.folder, options.key));
  // The reason of a failure quotes the program's standard error, which is collected in a temporary folder.
  std::optional<TemporaryFolder> errors;
  if (!ProgramsOf(prepared.scenarios).empty()) {
    ASSIGN_OR_RETURN(errors, TemporaryFolder::Make("replay"));
  }
  const std::string said = errors ? errors->path().string() : "";
  // Run the cells, and compare each one when its row arrives.
  const CurvesOfRun curves(run);
  std::map<std::size_t, CellCheck> checks;
  if (options.on_progress) options.on_progress(0, chosen.size());
  const auto whole = RunOrders(
      prepared.suite, plan, OrdersOf(plan, chosen),
      {.program = ThisProgram(), .error_folder = said, .fence = fence, .jobs = options.jobs, .stop = options.stop},
      [&](const DeliveredCell& cell) -> Result<void> {
        ASSIGN_OR_RETURN(const auto finished, cell.Read(plan));
        const std::size_t place = cell.head.cell;
        CellCheck& check = checks[place] = CompareRows(RowAt(run, place), finished.row);
        if (check.same) {
          RETURN_IF_ERROR(CompareKept(options.folder, curves.Of(check.cell, place), finished.row, check));
        }
        if (!options.cells.empty()) check.row = WithoutFiles(finished.row);
        if (options.on_progress) options.on_progress(checks.size(), chosen.size());
        return {};
      });
  if (!whole) return tl::unexpected(whole.error());
  RETURN_IF_ERROR(CheckStillThere(options.folder, run));
  for (auto& [cell, check] : checks) outcome.checks.push_back(std::move(check));
  return outcome;
}

}  // namespace etude
