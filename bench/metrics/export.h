#pragma once

#include <string>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// Returns the whole catalogue with its test vectors as one line of JSON (docs/schemas/metrics.schema.json). Other
/// implementations can use the vectors to prove that they agree.
Json MetricsJson();

/// Returns the text of docs/reference/metrics.md.
std::string MetricsPage();

/// Returns the rules that find faults of a motion (FaultRules), as a Markdown table.
std::string FaultsTable();

/// Returns the definitions of AddedMetrics in the order of their ids, as a manifest stores them. Each has the format of
/// a metric in MetricsJson, but its list of test vectors is empty.
Json AddedMetricsJson();
/// Adds the metrics of a list that AddedMetricsJson returned (AddMetric). Fails, naming `place`, at the first item that
/// is not a valid metric.
Result<void> ReadAddedMetrics(const Json& list, const Place& place);

}  // namespace etude
