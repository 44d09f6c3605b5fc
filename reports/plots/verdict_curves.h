#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/plots/judged_performances.h"

namespace etude {

/// The receiver operating characteristic of all performances that are not grey, pooled over people: (share of wrong
/// ones let through, share of right ones), from (0, 0) to (1, 1), equal scores in one step. Empty without a right or a
/// wrong one.
std::vector<std::pair<double, double>> PooledRoc(std::span<const JudgedPerformance> performances);

/// Where the method's own threshold lies on it. Nothing without a right or a wrong one.
std::optional<std::pair<double, double>> OperatedAt(std::span<const JudgedPerformance> performances);

/// The largest F1 that any threshold reaches on these performances: what the scores are worth, whatever a threshold was
/// set for. Nothing without a curve.
std::optional<double> BestF1(std::span<const JudgedPerformance> performances);

/// The area under a curve of such points, by trapezoids.
double AreaUnder(std::span<const std::pair<double, double>> curve);

/// A value and where 95 % of such values lie.
struct WithInterval {
  double value = 0, low = 0, high = 0;
};

/// The pooled area with an interval over people: jackknife, one person left out at a time (Efron and Tibshirani 1993,
/// chapter 11), ± 1.96 standard errors. Nothing without a curve, or when a person is needed for one.
std::optional<WithInterval> PooledArea(std::span<const JudgedPerformance> performances);

/// The share of faulty performances not called right by severity, in fifths: (middle, share), those without any left
/// out.
std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances);

/// The least severity from which on half of the faults are found, on straight lines between the points; nothing when
/// the curve does not rise through a half.
std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve);

/// The estimated share still waiting from each time on at which a wait ended (Kaplan and Meier 1958), after (the
/// earliest time, 1); what was given up is at risk until then.
std::vector<std::pair<double, double>> StillWaiting(std::vector<PraiseWait> waits);

/// A scenario's verdicts as curves, per condition: ROC of every method with its area, the same as a detection error
/// trade-off, faults found by severity, waits for praise. "" where methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
