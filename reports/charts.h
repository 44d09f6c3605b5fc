#pragma once

#include <optional>
#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// A picture of numbers: the data for assets/report.js, and the same in words for those who cannot see it.
struct Chart {
  std::string caption;      ///< what is drawn, with the unit
  std::string description;  ///< the figures in words
  std::string json;         ///< not yet escaped for HTML
  bool is_wide = false;     ///< needs all the page's width
};

/// Makes the chart of a method's errors over time: the median over its cells of their curves along iterations, or along
/// the frames of the first condition where methods follow a motion (others may have other frames). Nothing when the run
/// kept no such curves.
std::optional<Chart> CurveChart(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
