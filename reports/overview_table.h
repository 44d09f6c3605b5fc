#pragma once

#include <string>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// Writes all methods by all headline metrics: typical values, each with the sign of its verdict against the method's
/// baseline. Where something is swept there is a row per method and condition. "" when there is but one metric, or no
/// method.
std::string OverviewTableHtml(const ScenarioSummary& scenario);
std::string OverviewTableMarkdown(const ScenarioSummary& scenario);

/// Writes for each pair of a scenario of the task `pose-distance` whose worlds are single named pairs of poses how far
/// the poses are apart, and each method's verdict. "" for any other scenario.
std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario);
std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
