#include "bench/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "bench/results/folder.h"
#include "bench/run/manifest.h"
#include "bench/run/supervisor.h"
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
                                          const std::optional<ScoredMethod>& scored) {
  const auto was_run = [&](const Row& row) { return !scored || row.method != scored->name; };
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
  return chosen;
}

std::vector<Order> OrdersOf(const Plan& plan, const std::set<std::size_t>& cells) {
  std::vector<bool> done(plan.cell_count(), true);
  for (std::size_t cell : cells) done[cell] = false;
  return plan.OrdersFor(Shard{}, done);
}

}  // namespace

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
  ASSIGN_OR_RETURN(const auto chosen, ChooseCells(options, run, prepared.suite.scored));
  RETURN_IF_ERROR(CheckPrograms(options.folder, prepared.scenarios, options.outside));
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(prepared.scenarios, options.outside, options.folder, options.key));
  std::map<std::size_t, CellCheck> checks;
  const auto whole = RunOrders(
      prepared.suite, plan, OrdersOf(plan, chosen),
      {.program = ThisProgram(), .error_folder = "", .fence = fence, .jobs = options.jobs, .stop = options.stop},
      [&](const DeliveredCell& cell) -> Result<void> {
        ASSIGN_OR_RETURN(const auto finished, cell.Read(plan));
        checks.emplace(cell.head.cell, CompareRows(RowAt(run, cell.head.cell), finished.row));
        return {};
      });
  if (!whole) return tl::unexpected(whole.error());
  std::vector<CellCheck> list;
  for (auto& [cell, check] : checks) list.push_back(std::move(check));
  return list;
}

}  // namespace etude
