#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// The cost of one library size: the median over the trials.
struct GrowthPoint {
  double frames = 0;  ///< > 0
  double value = 0;   ///< > 0
};

struct GrowthCurve {
  std::size_t style = 0;            ///< colour and dashes: the method's index in the scenario
  std::vector<GrowthPoint> points;  ///< by frames; sizes without a measurement are left out
};

/// The curves of all methods, for conditions that differ only in the size of their library.
struct Growth {
  std::string label;  ///< of the other swept parameters; "" if there are none
  std::vector<GrowthCurve> distances;
  std::vector<GrowthCurve> microseconds;  ///< processor time per query; no points if the run has no times
};

/// Returns how a search's cost grows with its library; empty unless the scenario is a search that sweeps `frames`.
std::vector<Growth> ComputeGrowth(const RunData& run, const ScenarioSummary& scenario);

/// Draws the curves as an SVG element, both axes logarithmic in whole decades; "" if no curve has a point.
std::string GrowthPlotSvg(const std::vector<GrowthCurve>& curves, const std::string& title);

/// Returns true if the scenario is a search that sweeps the size of its library.
bool ShowsGrowth(const ScenarioSummary& scenario);

/// Returns the work and processor time of a query over the library's size, as curves and as a table; "" for other
/// scenarios. Work is the same on every machine; the times of a run that was merged from shards may come from several
/// machines.
std::string GrowthHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
