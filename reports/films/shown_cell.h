#pragma once

#include <optional>

#include "bench/model/recording.h"
#include "bench/model/run_data.h"

namespace etude {

/// A recorded cell to show.
struct ShownCell {
  const ScenarioSummary* scenario;
  const Row* row;
  const Recording* recording;
};

/// Chooses the cell that a film of the task `task` shows. Candidates are the recorded cells with status ok and the
/// track `track` in the first scenario of the task that has any, preferably cells of the method that the scenario's
/// question is about. Returns the candidate with the median value of the first headline metric: a typical cell, not
/// the best one.
std::optional<ShownCell> ChooseCell(const RunData& run, std::string_view task, std::string_view track);

/// Chooses a cell of one scenario by the rule of the function above.
std::optional<ShownCell> ChooseCell(const RunData& run, const ScenarioSummary& scenario, std::string_view track);

/// Finds a curve (one value per frame or iteration) of a cell by the curve's name; null if the cell has none.
const Series* FindSeries(const RunData& run, const Row& row, std::string_view name);

}  // namespace etude
