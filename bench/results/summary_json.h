#pragma once

#include "bench/files/json.h"
#include "bench/model/summary.h"

namespace etude {

/// summary.json: every scenario's aggregates, comparisons and expectations.
Json EncodeSummaries(const std::vector<ScenarioSummary>& scenarios);
Result<std::vector<ScenarioSummary>> DecodeSummaries(const Json& json, const Place& place);

}  // namespace etude
