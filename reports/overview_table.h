#pragma once

#include <string>
#include <string_view>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// Writes all methods by all metrics, headline ones first: typical values with their intervals, the signs of their
/// verdicts, and below which values are missing and why. Where something is swept there is a row per method and
/// condition. "" when no method has a value.
std::string OverviewTableHtml(const RunData& run, const ScenarioSummary& scenario);
/// Writes the same of the headline metrics, without intervals; "" when there is but one.
std::string OverviewTableMarkdown(const ScenarioSummary& scenario);

/// Explains the signs of such tables.
inline constexpr std::string_view kSigns =
    "In tables the first sign is of the verdict against the method’s baseline, the second against the strongest other "
    "method: ▲ better, ▼ worse, = no difference that matters, ? undecided, · not compared; in brackets on these worlds "
    "only. Figures are medians, or means of shares and scores, with 95 % intervals.";

/// Writes a table of named pairs of poses: how far each pair is apart, and each method's verdict. Only of a scenario of
/// the task `pose-distance` whose worlds are such single pairs; "" for any other.
std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario);
std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
