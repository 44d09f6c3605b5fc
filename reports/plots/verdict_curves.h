#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/plots/judged_performances.h"

namespace etude {

/// The share of faulty performances not called right by severity, in fifths: (middle, share), those without any left
/// out.
std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances);

/// The least severity from which on half of the faults are found, on straight lines between the points; nothing when
/// the curve does not rise through a half.
std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve);

/// A scenario's verdicts as curves, per condition: ROC of every method with its area, the same as a detection error
/// trade-off, faults found by severity, waits for praise. "" where methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
