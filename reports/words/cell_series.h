#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// Finds the series of a run's cells by name. The run must outlive it, and the rows asked for be the run's own.
class CellSeriesIndex {
 public:
  explicit CellSeriesIndex(const RunData& run);

  /// Finds a series of a cell; null when it keeps none of that name.
  const std::vector<double>* Find(const Row& row, std::string_view name) const;

 private:
  std::map<const Row*, const std::vector<Series>*> cells_;
};

/// Knows which cells of a run kept a recording. The run must outlive it.
class KeptCells {
 public:
  explicit KeptCells(const RunData& run);

  /// Finds what a cell recorded; null where it kept nothing.
  const Recording* Find(const std::string& cell) const;
  /// Gives the attribute by which the page's scripts know a recorded cell, ` data-cell="ID"`; "" for any other cell.
  std::string Attribute(const std::string& cell) const;

 private:
  std::map<std::string_view, const Recording*> cells_;
};

/// Is true when any cell of this scenario keeps a series of that name.
bool KeepsSeries(const RunData& run, const ScenarioSummary& scenario, std::string_view name);

/// Gives the rows of a scenario under one condition, in order, and looks at few others: rows of one condition lie
/// together, so that a page of many conditions does not pass all rows for each.
std::vector<const Row*> RowsUnder(const RunData& run, const std::string& scenario,
                                  const std::vector<SweptValue>& condition);

/// Gives, of all recordings whose cell has a row, in order, both.
std::vector<std::pair<const Row*, const CellRecording*>> RecordedRows(const RunData& run);

/// Computes the median of each step over several curves of different lengths: a curve that ended keeps its last value,
/// as a solver that stopped keeps its answer.
std::vector<double> MedianCurve(const std::vector<const std::vector<double>*>& curves);

}  // namespace etude
