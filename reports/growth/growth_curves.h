#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// What one library size costs: the median over the trials.
struct GrowthPoint {
  double frames = 0;  ///< > 0
  double value = 0;   ///< > 0
};

struct GrowthCurve {
  std::size_t style = 0;            ///< colour and dashes: the method's index in the scenario
  std::vector<GrowthPoint> points;  ///< by frames; sizes at which nothing was measured are left out
};

/// The curves of all methods under conditions that differ in nothing but their library's size.
struct Growth {
  std::string label;  ///< of what else is swept, "" when nothing is
  std::vector<GrowthCurve> distances;
  std::vector<GrowthCurve> microseconds;  ///< processor time per query; no points in a run without times
};

/// Nothing unless the scenario is a search that sweeps `frames`.
std::vector<Growth> ComputeGrowth(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
