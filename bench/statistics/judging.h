#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/model/study.h"
#include "bench/model/summary.h"
#include "bench/statistics/scenario_table.h"

namespace etude {

/// Returns the p-values after Holm's step-down correction (1979). If each is compared with alpha, the probability of at
/// least one false rejection among all of them is at most alpha. A missing p counts as a comparison but stays missing.
std::vector<std::optional<double>> HolmCorrected(std::span<const std::optional<double>> p_values);

/// Returns the reason why the verdict is undecided; if several reasons hold, the first in the order in which a reader
/// would check them. Returns "" if the verdict is clear. `comparisons` is the number of comparisons that were judged
/// together (Holm); each of them compares worlds, or people if `unit` says so.
std::string WhyOpen(const Comparison& c, const MetricInfo& metric, int comparisons, SamplingUnit unit);

/// A comparison to be judged, and the same comparison with failures counted as losses (WithFailures).
struct Question {
  Comparison comparison;
  std::optional<Comparison> with_failures;
};

/// Corrects the deciding p-values of comparisons that belong together (Holm), judges each comparison again, and sets
/// its notes and the reason for an open verdict. A comparison without a p also counts in the correction. If only one
/// method failed in some worlds, the p with failures counted is used, and the verdict must be the same with and without
/// failures. The verdicts for other units are corrected as a separate family and judged by the same rule. If every
/// world is its own `unit`, they equal the verdicts for these worlds.
void JudgeFamily(std::span<Question* const> family, SamplingUnit unit = SamplingUnit::kWorld);

/// Judges the comparisons with baselines again for a study whose verdicts must be the same under every value of
/// Study::across. Returns one verdict per comparison and per condition of the other swept parameters, in the order of
/// `conditions`. Returns no verdicts if Study::across is empty.
std::vector<AcrossVerdict> JudgeAcross(const Study& study, const std::vector<ConditionSummary>& conditions);

/// Judges one expectation over every condition that it names. A comparison (below, above) is met if, in every such
/// condition, the paired verdict at the expectation's confidence agrees with the expectation. It is unmet if the
/// verdict is the opposite or "no difference" in one of the conditions, and otherwise undecided. "No difference"
/// becomes undecided if one of the two methods loses values, as in JudgeFamily. Because every condition must hold, no
/// correction for multiple conditions is needed (intersection–union test, Berger 1982). A bound (at_most, at_least) is
/// compared with the statistic itself. If some cells have no value, a bound that the other cells meet is undecided. If
/// the expectation says that the method is better in the value metric (ValueMetricOf), worse success also makes the
/// expectation unmet.
ExpectationResult JudgeExpectation(const Expectation& expectation, const Study& study, const ScenarioTable& table,
                                   std::uint64_t seed);

}  // namespace etude
