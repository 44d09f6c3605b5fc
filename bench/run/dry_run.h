#pragma once

#include <string>
#include <vector>

#include "bench/model/unit.h"
#include "bench/run/costs.h"
#include "bench/run/run.h"

namespace etude {

/// The time that a scenario would take, and the differences that it could show.
struct ScenarioForecast {
  std::string name, task;
  std::size_t worlds = 0;      ///< of each condition
  std::size_t conditions = 0;  ///< values of what is swept
  std::size_t methods = 0;
  std::string work = {};         ///< WorkOf
  bool is_kept = false;          ///< its costs come from ReadKeptCosts; else first worlds were measured
  double seconds_per_world = 0;  ///< all methods of a world, by the clock, on one worker
  int comparisons = 0;           ///< judged together
  SamplingUnit unit = SamplingUnit::kWorld;
  int units = 0;  ///< of the first condition; worlds where every world is its own
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  double seconds = 0;  ///< by the clock, on `workers`
  int workers = 1;
  Pace pace;
};

/// Reads and checks everything as Run does and writes nothing. What shipped scenarios cost is kept, and scaled by this
/// machine's pace; of others, and with other clips or recordings than their own, first worlds of conditions are run
/// until `sample_seconds` have passed, one of each scenario at least.
Result<Forecast> DryRun(const RunOptions& options, double sample_seconds);

}  // namespace etude
