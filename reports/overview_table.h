#pragma once

#include <string>
#include <string_view>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"

namespace etude {

/// Returns a table of all methods by all metrics, headline metrics first. A cell shows the median or mean with its
/// interval, and the symbols of the verdicts. A list of the missing values with their reasons follows. If a parameter
/// is swept, each row is one method under one condition. Returns "" if no method has a value.
std::string OverviewTableHtml(const RunData& run, const ScenarioSummary& scenario);
/// Returns the medians or means of the headline metrics as a Markdown table, without intervals; "" if there is only one
/// headline metric.
std::string OverviewTableMarkdown(const ScenarioSummary& scenario);

/// Explains the verdict symbols in the tables of methods by metrics.
inline constexpr std::string_view kSigns =
    "In tables, the first sign is the verdict against the method’s baseline. The second sign is the verdict against "
    "the strongest other method. ▲ better, ▼ worse, = no difference that matters, ? undecided, · not compared. A sign "
    "in brackets, such as (=), is a verdict about these worlds only; there is no verdict about other clips or people. "
    "Numbers are medians; for shares and scores, they are means. Intervals have 95 % confidence.";

/// Returns a table of named pairs of poses: the distance of each pair and each method's verdict. Returns "" unless the
/// task is `pose-distance` and every world is a single pair.
std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario);
std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
