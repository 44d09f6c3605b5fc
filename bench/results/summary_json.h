#pragma once

#include "bench/model/summary.h"
#include "io/files/json.h"

namespace etude {

/// Encodes summary.json: the aggregates, comparisons and expectations of every scenario.
Json EncodeSummaries(const std::vector<ScenarioSummary>& scenarios);
Result<std::vector<ScenarioSummary>> DecodeSummaries(const Json& json, const Place& place);

}  // namespace etude
