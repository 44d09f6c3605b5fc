#include "reports/words/cell_series.h"

#include <algorithm>

#include "reports/words/escape.h"

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
  for (const CellRecording& recorded : run.recordings) cells_.insert(recorded.cell);
}

std::string KeptCells::Attribute(const std::string& cell) const {
  return cells_.contains(cell) ? " data-cell=\"" + EscapeMarkup(cell) + "\"" : "";
}

bool KeepsSeries(const RunData& run, const ScenarioSummary& scenario, std::string_view name) {
  const CellSeriesIndex series(run);
  return std::ranges::any_of(
      run.rows, [&](const Row& row) { return row.scenario == scenario.name && series.Find(row, name) != nullptr; });
}

std::vector<const Row*> RowsUnder(const RunData& run, const ScenarioSummary& scenario,
                                  const std::vector<SweptValue>& condition) {
  std::vector<const Row*> rows;
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && row.condition == condition) rows.push_back(&row);
  }
  return rows;
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
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
