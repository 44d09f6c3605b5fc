#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Whether the scenario is a search that sweeps the size of its library.
bool ShowsGrowth(const ScenarioSummary& scenario);

/// Work and processor time of a query over the library's size, as curves and as a table; "" for other scenarios.
std::string GrowthHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
