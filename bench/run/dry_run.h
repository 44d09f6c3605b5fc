#pragma once

#include <string>
#include <vector>

#include "bench/model/unit.h"
#include "bench/run/costs.h"
#include "bench/run/run.h"

namespace etude {

/// The forecast of a scenario: its size, its time, and its numbers of units and comparisons.
struct ScenarioForecast {
  std::string name, task;
  std::size_t worlds = 0;  ///< worlds per condition
  std::size_t conditions = 0;
  std::size_t methods = 0;
  std::string work = {};  ///< the result of WorkOf
  bool is_kept = false;   ///< true: the time comes from ReadKeptCosts; false: it was measured on the first worlds
  double seconds_per_world = 0;  ///< wall time of a world with all methods, on one worker
  int comparisons = 0;           ///< number of comparisons under one Holm correction
  SamplingUnit unit = SamplingUnit::kWorld;
  int units = 0;            ///< number of units in the first condition; the number of worlds if each is a unit
  std::string metric = {};  ///< the metric that answers compare (ValueMetricOf), or the success metric
  /// The standard deviation over worlds of the differences in `metric` between two methods, in the metric's unit: the
  /// first method that is compared with another, and its baseline. It is the median over conditions. It is stored, or
  /// comes from the worlds that were run to measure the time. 0 = there are fewer than kMinSample pairs.
  double spread = 0;
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  std::size_t cells = 0;  ///< cells of the shard, or of the whole run
  double seconds = 0;     ///< wall time of these cells, on `workers` workers
  int workers = 1;
  Pace pace;
};

/// Checks all input as Run does, estimates the time, and writes nothing. For a shipped scenario with its own clips and
/// recordings, the stored cost is scaled by this machine's speed; clips are not read and recognisers are not trained.
/// For any other scenario, the first worlds are run until `sample_seconds` have passed, at least one per scenario.
Result<Forecast> DryRun(const RunOptions& options, double sample_seconds);

}  // namespace etude
