#pragma once

#include <optional>

#include "bench/model/recording.h"
#include "bench/model/run_data.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// A recorded cell that is worth showing.
struct CastCell {
  const ScenarioSummary* scenario;
  const Row* row;
  const Recording* recording;
};

/// Chooses the cell that the film shows of this kind of task: among the recorded cells that ended well and have this
/// track, those of the method that answers the scenario's question (else of any method), and of these the one in the
/// middle by the first headline metric. It is a typical cell, not the best one.
std::optional<CastCell> ChooseCell(const RunData& run, std::string_view task, std::string_view track);

/// Chooses a cell of one scenario in the same way.
std::optional<CastCell> ChooseCell(const RunData& run, const ScenarioSummary& scenario, std::string_view track);

/// Finds the curve of that name of a cell, or null.
const Series* FindSeries(const RunData& run, const Row& row, std::string_view name);

}  // namespace etude
