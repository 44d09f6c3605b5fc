#include "reports/words/cell_series.h"

#include <algorithm>

#include "engine/base/order_statistics.h"
#include "io/drawing/escape.h"

namespace etude {

CellSeriesIndex::CellSeriesIndex(const RunData& run) {
  std::map<std::string_view, const std::vector<Series>*> by_id;
  for (const CellSeries& cell : run.series) by_id.emplace(cell.cell, &cell.series);
  if (by_id.empty()) return;
  for (const Row& row : run.rows) {
    if (const auto found = by_id.find(row.Id()); found != by_id.end()) cells_.emplace(&row, found->second);
  }
}

const std::vector<double>* CellSeriesIndex::Find(const Row& row, std::string_view name) const {
  const auto cell = cells_.find(&row);
  if (cell == cells_.end()) return nullptr;
  const Series* series = FindByName(*cell->second, name);
  return series == nullptr ? nullptr : &series->values;
}

KeptCells::KeptCells(const RunData& run) {
  for (const CellRecording& recorded : run.recordings) cells_.emplace(recorded.cell, &recorded.recording);
}

const Recording* KeptCells::Find(const std::string& cell) const {
  const auto found = cells_.find(cell);
  return found == cells_.end() ? nullptr : found->second;
}

std::string KeptCells::Attribute(const std::string& cell) const {
  return Find(cell) != nullptr ? " data-cell=\"" + EscapeMarkup(cell) + "\"" : "";
}

bool KeepsSeries(const RunData& run, const ScenarioSummary& scenario, std::string_view name) {
  const CellSeriesIndex series(run);
  return std::ranges::any_of(
      run.rows, [&](const Row& row) { return row.scenario == scenario.name && series.Find(row, name) != nullptr; });
}

std::vector<const Row*> RowsUnder(const RunData& run, const std::string& scenario,
                                  const std::vector<SweptValue>& condition) {
  std::vector<const Row*> rows;
  for (auto first = run.rows.begin(); first != run.rows.end();) {
    const auto is_like_first = [&](const Row& row) {
      return row.scenario == first->scenario && row.condition == first->condition;
    };
    const auto end = std::partition_point(first, run.rows.end(), is_like_first);
    if (first->scenario == scenario && first->condition == condition) {
      for (; first != end; ++first) rows.push_back(&*first);
      return rows;
    }
    first = end;
  }
  return rows;
}

std::vector<std::pair<const Row*, const CellRecording*>> RecordedRows(const RunData& run) {
  std::map<std::string, const Row*> rows;
  const KeptCells kept(run);
  for (const Row& row : run.rows) {
    if (std::string id = row.Id(); kept.Find(id) != nullptr) rows.emplace(std::move(id), &row);
  }
  std::vector<std::pair<const Row*, const CellRecording*>> recorded;
  for (const CellRecording& recording : run.recordings) {
    if (const auto row = rows.find(recording.cell); row != rows.end()) recorded.emplace_back(row->second, &recording);
  }
  return recorded;
}

std::vector<double> MedianCurve(const std::vector<const std::vector<double>*>& curves) {
  std::size_t longest = 0;
  for (const auto* curve : curves) longest = std::max(longest, curve->size());
  std::vector<double> median;
  for (std::size_t step = 0; step < longest; ++step) {
    std::vector<double> values;
    for (const auto* curve : curves) {
      if (!curve->empty()) values.push_back((*curve)[std::min(step, curve->size() - 1)]);
    }
    median.push_back(Median(std::move(values)));
  }
  return median;
}

}  // namespace etude
