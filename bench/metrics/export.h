#pragma once

#include <string>

namespace etude {

/// The whole catalogue with its test vectors, for other implementations to prove their agreement by
/// (docs/schemas/metrics.schema.json): one line of JSON.
std::string MetricsJson();

/// docs/reference/metrics.md.
std::string MetricsPage();

}  // namespace etude
