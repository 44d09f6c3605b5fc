#pragma once

#include <string>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// Returns the whole catalogue with its test vectors as one line of JSON (docs/schemas/metrics.schema.json), so that
/// other implementations can prove their agreement.
Json MetricsJson();

/// Returns the text of docs/reference/metrics.md.
std::string MetricsPage();

/// Returns the rules by which faults of a motion are found (FaultRules), as a table of Markdown.
std::string FaultsTable();

/// Returns the definitions of AddedMetrics by id, as a manifest keeps them: the catalogue's JSON without test vectors
/// and with `reads`.
Json AddedMetricsJson();
/// Adds the metrics of such a list (AddMetric). Fails, naming `place`, at an item that is not a valid metric.
Result<void> ReadAddedMetrics(const Json& list, const Place& place);

}  // namespace etude
