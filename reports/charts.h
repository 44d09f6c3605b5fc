#pragma once

#include <optional>
#include <string>

#include "bench/results/run_data.h"

namespace etude {

/// A picture of numbers: the data for assets/report.js, and the same in words for those who cannot see it.
struct Chart {
  std::string caption;      ///< what is drawn, with the unit
  std::string description;  ///< the figures in words
  std::string json;         ///< not yet escaped for HTML
  int rows = 0;             ///< of a chart that lies on its side; 0 = upright
};

/// The typical value (median, or mean of a share) with its 95 % interval of the scenario's first headline
/// metric, per method and condition; nothing when no cell has a value.
std::optional<Chart> IntervalChart(const ScenarioSummary& scenario);

/// How an iterative method gets there: the median over all cells of each method's curves along
/// iterations; nothing when the run kept no such curves.
std::optional<Chart> ConvergenceChart(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
