#pragma once

#include <span>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"

namespace etude {

/// Sums up one study's rows: per condition and method the aggregate of every metric with its
/// interval and its share of cells that are ok, every method against its baseline on the headline metrics, judged
/// as one family, and the verdict on each expectation. `rows` are its own, in canonical order. Seeded, so
/// the same rows give the same bytes.
ScenarioSummary Summarise(const Study& study, std::span<const Row> rows, std::uint64_t seed);

}  // namespace etude
