#pragma once

#include <string>
#include <vector>

#include "bench/model/unit.h"
#include "bench/run/costs.h"
#include "bench/run/run.h"

namespace etude {

/// The forecast of a scenario: its numbers of worlds, sampling units and comparisons, its time, and the spread of its
/// differences.
struct ScenarioForecast {
  std::string name, task;
  std::size_t worlds = 0;  ///< number of worlds per condition
  std::size_t conditions = 0;
  std::size_t methods = 0;
  std::string work = {};  ///< digest of the scenario's worlds and methods (WorkOf)
  /// True: the time is a stored cost (ReadKeptCosts); false: the time was measured on the first worlds.
  bool is_kept = false;
  double seconds_per_world = 0;  ///< wall time of a world with all methods, on one worker
  int comparisons = 0;           ///< number of comparisons to which one Holm correction applies together
  int needed = 0;                ///< number of worlds per condition below which no verdict is possible (WorldsNeeded)
  SamplingUnit unit = SamplingUnit::kWorld;
  /// Number of sampling units in the first condition; equals the number of worlds if each world is its own unit.
  int units = 0;
  /// The metric of `spread`: the value metric of the scenario's answers (ValueMetricOf), or, if there is none, the
  /// success metric.
  std::string metric = {};
  /// The standard deviation, over worlds, of the paired differences in `metric`, in the metric's unit. The compared
  /// methods are the first method that has a baseline, and its baseline. The value is the median over conditions. The
  /// value is stored, or computed from the worlds that were run to measure the time. 0 = no condition has kMinSample
  /// pairs, or no method has a baseline.
  double spread = 0;
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  std::vector<RefusedClip> refused = {};  ///< clips and recordings that the run would leave out, each listed once
  std::size_t cells = 0;  ///< number of cells in the shard, or in the whole run
  double seconds = 0;     ///< wall time of `cells` cells with `workers` workers, seconds
  int workers = 1;
  Pace pace;
};

/// Estimates the time of a run, and writes nothing. If a scenario's cost is stored (ReadKeptCosts) and no option
/// changes its clips or recordings, the stored cost is scaled by this machine's speed. The input of such a scenario
/// is loaded only if a part of it comes neither with the program nor with a package, or if its sampling units must be
/// counted. The input of all other scenarios is checked as in Run; their worlds are run for `sample_seconds` in all,
/// and at least one world of each scenario.
Result<Forecast> DryRun(const RunOptions& options, double sample_seconds);

}  // namespace etude
