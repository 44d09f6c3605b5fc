#pragma once

#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// How many comparisons of methods with their baselines are judged together.
int CountComparisons(const Study& study);

/// Sums up one study's rows: per condition and method the aggregate of every metric with its
/// interval and its share of cells that are ok, every method against its baseline on the headline metrics, judged
/// as one family, every method against the strongest other one (rival.h), judged as another, and the verdict on each
/// expectation. Seeded, so the same rows give the same bytes.
ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed);

}  // namespace etude
