#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// Finds the series of a run's cells by name. The run must outlive the index, and rows passed to it must belong to the
/// run.
class CellSeriesIndex {
 public:
  explicit CellSeriesIndex(const RunData& run);

  /// Returns the cell's series of this name; null if the cell has none.
  const std::vector<double>* Find(const Row& row, std::string_view name) const;

 private:
  std::map<const Row*, const std::vector<Series>*> cells_;
};

/// Finds the recordings of a run's cells. The run must outlive this object.
class KeptCells {
 public:
  explicit KeptCells(const RunData& run);

  /// Returns the recording of a cell; null if the cell has no recording.
  const Recording* Find(const std::string& cell) const;
  /// Returns the HTML attribute by which the page's scripts find a recorded cell, ` data-cell="ID"`; "" if the cell has
  /// no recording.
  std::string Attribute(const std::string& cell) const;

 private:
  std::map<std::string_view, const Recording*> cells_;
};

/// Returns true if any cell of this scenario keeps a series of that name.
bool KeepsSeries(const RunData& run, const ScenarioSummary& scenario, std::string_view name);

/// Returns the rows of a scenario under one condition, in the run's order. Rows of one condition are contiguous, so the
/// search does not visit all rows.
std::vector<const Row*> RowsUnder(const RunData& run, const std::string& scenario,
                                  const std::vector<SweptValue>& condition);

/// Returns each recording together with the row of its cell, in the run's order. Recordings without a row are left out.
std::vector<std::pair<const Row*, const CellRecording*>> RecordedRows(const RunData& run);

/// Returns the median curve of several curves: at each index, the median of the curves' values. A curve that has ended
/// keeps its last value, because a solver that has stopped keeps its answer.
std::vector<double> MedianCurve(const std::vector<const std::vector<double>*>& curves);

}  // namespace etude
