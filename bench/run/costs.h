#pragma once

#include <map>
#include <string>

#include "bench/scenario/scenario.h"
#include "engine/base/result.h"

namespace etude {

/// Names what a scenario's worlds and methods are made of, whatever it asks, expects and calls them, and however many
/// trials it has: two scenarios of one work cost the same a trial.
std::string WorkOf(const Scenario& scenario);

/// The processor time of a scenario, in yardsticks (MeasurePace).
struct KeptCost {
  double once = 0;   ///< start, what conditions prepare, statistics
  double trial = 0;  ///< a world of every condition, with all methods
};

/// The costs of shipped scenarios by WorkOf, as `scripts/costs` measured them; none where nothing is shipped. A table
/// that cannot be read is refused.
Result<std::map<std::string, KeptCost>> ReadKeptCosts();

/// The speed of this machine as it is now, other people's work on it included.
struct Pace {
  double yardsticks_per_s = 0;  ///< by the clock, of all workers together
  double yardstick_ms = 0;      ///< processor time of one: half a millisecond of an AMD EPYC
};

/// Has as many copies of this process as there will be workers do fixed arithmetic for an eighth of a second.
Result<Pace> MeasurePace(int workers);

}  // namespace etude
