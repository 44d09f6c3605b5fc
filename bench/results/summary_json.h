#pragma once

#include "bench/model/summary.h"
#include "io/files/json.h"

namespace etude {

/// summary.json: every scenario's aggregates, comparisons and expectations.
Json EncodeSummaries(const std::vector<ScenarioSummary>& scenarios);
Result<std::vector<ScenarioSummary>> DecodeSummaries(const Json& json, const Place& place);

}  // namespace etude
