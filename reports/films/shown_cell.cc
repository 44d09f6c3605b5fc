#include "reports/films/shown_cell.h"

#include <algorithm>
#include <vector>

#include "engine/base/named.h"
#include "reports/words/cell_series.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

std::vector<ShownCell> RecordedCells(const RunData& run, const ScenarioSummary& scenario, std::string_view track) {
  std::vector<ShownCell> cells;
  const KeptCells kept(run);
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name || row.result.status != Status::kOk) continue;
    const Recording* recording = kept.Find(row.Id());
    if (recording == nullptr) continue;
    const BodyMotion* motion = FindTrack(*recording, track);
    if (motion != nullptr && !motion->poses.empty()) cells.push_back({&scenario, &row, recording});
  }
  return cells;
}

ShownCell MiddleOf(std::vector<ShownCell> cells, const std::string& metric) {
  // Sort by value; cells without a value come last, and equal values keep the order of the run.
  std::ranges::stable_sort(cells, [&](const ShownCell& a, const ShownCell& b) {
    const auto x = ValueOf(*a.row, metric), y = ValueOf(*b.row, metric);
    return x.has_value() != y.has_value() ? x.has_value() : x && *x < *y;
  });
  const auto valued =
      std::ranges::count_if(cells, [&](const ShownCell& c) { return ValueOf(*c.row, metric).has_value(); });
  return cells[static_cast<std::size_t>(valued > 0 ? (valued - 1) / 2 : 0)];
}

}  // namespace

std::optional<ShownCell> ChooseCell(const RunData& run, const ScenarioSummary& scenario, std::string_view track) {
  const std::vector<ShownCell> cells = RecordedCells(run, scenario, track);
  if (cells.empty()) return std::nullopt;
  const ScenarioFindings findings = FindingsOf(run, scenario);
  std::vector<ShownCell> preferred;
  std::ranges::copy_if(cells, std::back_inserter(preferred),
                       [&](const ShownCell& cell) { return cell.row->method == findings.answer.method; });
  return MiddleOf(preferred.empty() ? cells : preferred, findings.metric);
}

std::optional<ShownCell> ChooseCell(const RunData& run, std::string_view task, std::string_view track) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.task != task) continue;
    if (auto cell = ChooseCell(run, scenario, track)) return cell;
  }
  return std::nullopt;
}

const Series* FindSeries(const RunData& run, const Row& row, std::string_view name) {
  const auto cell = std::ranges::find(run.series, row.Id(), &CellSeries::cell);
  if (cell == run.series.end()) return nullptr;
  return FindByName(cell->series, name);
}

}  // namespace etude
