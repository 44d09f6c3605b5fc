#pragma once

#include <string>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// The whole catalogue with its test vectors, for other implementations to prove their agreement by
/// (docs/schemas/metrics.schema.json): one line of JSON.
Json MetricsJson();

/// docs/reference/metrics.md.
std::string MetricsPage();

/// The definitions of AddedMetrics as a manifest keeps them, as in the catalogue's JSON but without test vectors, and
/// with `reads`; by id.
Json AddedMetricsJson();
/// Adds the metrics of such a list (AddMetric). Fails, naming `place`, on what is none.
Result<void> ReadAddedMetrics(const Json& list, const Place& place);

}  // namespace etude
