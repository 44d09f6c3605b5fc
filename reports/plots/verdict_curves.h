#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// A performance that a method judged.
struct JudgedPerformance {
  int person = 0;    ///< who performed it: the trial
  double score = 0;  ///< higher: looks righter
  double truth = 0;  ///< 1 right, ½ grey, 0 wrong
  bool is_called = false;
  double severity = 0;  ///< of its worst fault; 0: none
};

/// The receiver operating characteristic of all performances that are not grey, pooled over people: (share of wrong
/// ones let through, share of right ones), from (0, 0) to (1, 1), equal scores in one step. Empty without a right or a
/// wrong one.
std::vector<std::pair<double, double>> PooledRoc(std::span<const JudgedPerformance> performances);

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

/// A scenario's verdicts as curves, per condition: ROC of every method with its area, faults found by severity. ""
/// where methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
