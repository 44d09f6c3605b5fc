#pragma once

#include <string>

#include "engine/base/result.h"

namespace etude {

/// The whole catalogue with its test vectors, for other implementations to prove their agreement by
/// (docs/schemas/metrics.schema.json): one line of JSON. Fails only when a built-in vector file cannot be read.
Result<std::string> MetricsJson();

/// docs/metrics.md.
Result<std::string> MetricsPage();

}  // namespace etude
