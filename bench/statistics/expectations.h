#pragma once

#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Judges one expectation over every condition it names. A comparison (below, above) is met when the
/// paired verdict at its confidence is clear in every such condition, unmet when it is clear the other way or shows
/// no difference in one, else undecided. Because every condition must hold, none needs a correction for the others
/// (intersection–union test, Berger 1982). A bound (at_most, at_least) compares the statistic itself; cells
/// without a value leave it undecided, for a missing value is never a good one.
ExpectationResult JudgeExpectation(const Expectation& expectation, const Study& study, const ScenarioTable& table,
                                   std::uint64_t seed);

}  // namespace etude
