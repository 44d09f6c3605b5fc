#pragma once

#include <string>
#include <vector>

#include "bench/model/unit.h"
#include "bench/run/run.h"

namespace etude {

/// The time that a scenario would take, and the differences that it could show.
struct ScenarioForecast {
  std::string name, task;
  std::size_t worlds = 0;      ///< of each condition
  std::size_t conditions = 0;  ///< values of what is swept
  std::size_t methods = 0;
  double seconds_per_world = 0;  ///< all methods of a world, measured on first worlds of conditions
  int comparisons = 0;           ///< judged together
  SamplingUnit unit = SamplingUnit::kWorld;
  int units = 0;  ///< of the first condition; worlds where every world is its own
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  double seconds = 0;  ///< by the clock, on `workers`
  int workers = 1;
};

/// Reads and checks everything as Run does, writes nothing, and runs first worlds of conditions until
/// `sample_seconds` have passed, one of each scenario at least.
Result<Forecast> DryRun(const RunOptions& options, double sample_seconds);

}  // namespace etude
