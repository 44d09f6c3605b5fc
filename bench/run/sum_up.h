#pragma once

#include "bench/statistics/summary.h"

namespace etude {

/// Summarise, of many rows with conditions shared out among `jobs` processes; the same summary for any number of them.
Result<ScenarioSummary> SumUp(const Study& study, const ScenarioTable& table, std::uint64_t seed, int jobs);

}  // namespace etude
