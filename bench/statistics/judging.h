#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Holm's step-down correction (1979): each p as if it alone had been asked, so that among all of them one is wrongly
/// at most alpha with probability alpha. A missing p counts in the number of questions, and stays missing.
std::vector<std::optional<double>> HolmCorrected(std::span<const std::optional<double>> p_values);

/// A comparison to be judged, and the same with failures counted as losses (WithFailures).
struct Question {
  Comparison comparison;
  std::optional<Comparison> with_failures;
};

/// Corrects the deciding p-values of comparisons that were all asked together (Holm), judges each anew, and says on
/// it why its verdict is open and what else to know before believing it. One without a p counts as a question too.
/// Where one method alone failed, the p is the one with failures counted, and the verdict must be the same with and
/// without them. The verdicts beyond these worlds are a family of their own, judged alike; where every world is its
/// own `unit` they are those on these worlds.
void JudgeFamily(std::span<Question* const> family, SamplingUnit unit = SamplingUnit::kWorld);

/// Judges the comparisons with baselines again when a verdict only counts if it is the same under every value of
/// Study::across: one for each comparison and each condition of all that is swept otherwise, in the order of
/// `conditions`. None where the study asks for nothing.
std::vector<AcrossVerdict> JudgeAcross(const Study& study, const std::vector<ConditionSummary>& conditions);

/// Judges one expectation over every condition it names. A comparison (below, above) is met when the
/// paired verdict at its confidence is clear in every such condition, unmet when it is clear the other way or shows
/// no difference in one, else undecided. Because every condition must hold, none needs a correction for the others
/// (intersection–union test, Berger 1982). A bound (at_most, at_least) compares the statistic itself; cells
/// without a value leave it undecided, for a missing value is never a good one.
ExpectationResult JudgeExpectation(const Expectation& expectation, const Study& study, const ScenarioTable& table,
                                   std::uint64_t seed);

}  // namespace etude
