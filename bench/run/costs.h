#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/scenario/scenario.h"
#include "engine/base/result.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns a digest of everything that determines a scenario's cost per trial: its worlds and methods. The question,
/// expectations, names and number of trials do not affect the digest.
std::string WorkOf(const Scenario& scenario);

/// The measured processor time of a scenario, in yardsticks. A yardstick is a fixed amount of arithmetic (MeasurePace).
struct KeptCost {
  /// Cost that does not depend on the number of trials: start-up, preparation of conditions, and statistics.
  double once = 0;
  double trial = 0;   ///< cost of one trial: one world of every condition, with all methods
  double spread = 0;  ///< standard deviation of paired differences (ScenarioForecast::spread); 0 = not measured
  /// The number of sampling units (ScenarioForecast::units) with `trials` trials and the seed `seed`. 0 = not stored,
  /// because each world is its own unit.
  int units = 0;
  int trials = 0;
  std::uint64_t seed = 0;

  std::optional<int> UnitsOf(int of_trials, const Seed& of_seed) const {
    const bool is_same = units > 0 && of_trials == trials && of_seed == Seed(seed);
    return is_same ? std::optional(units) : std::nullopt;
  }
};

/// Reads the stored costs of shipped scenarios. The keys are the digests that WorkOf returns. The result is empty if no
/// table of costs is shipped. Fails if the table is invalid.
Result<std::map<std::string, KeptCost>> ReadKeptCosts();

/// The usual processor time of one yardstick (on an AMD EPYC), seconds.
inline constexpr double kYardstickS = 0.0005;

/// The speed of this machine under its present load.
struct Pace {
  double yardsticks_per_s = 0;  ///< yardsticks of work per second of wall time, all workers together
  double yardstick_ms = 0;      ///< processor time of one yardstick, ms (kYardstickS)
};

/// Measures the speed of this machine: one copy of this process per worker repeats a fixed computation (a yardstick)
/// for an eighth of a second.
Result<Pace> MeasurePace(int workers);

/// The expected work of each cell of a run. The remaining time of the run is estimated from these numbers.
class ExpectedWork {
 public:
  /// `kept` are the stored costs (ReadKeptCosts). A cell of a scenario without stored cost counts as much as the other
  /// cells do on average; if no cost is known, every cell counts 1. The plan must outlive this object.
  ExpectedWork(const Plan& plan, const std::map<std::string, KeptCost>& kept);

  /// `Of` returns the expected work of a cell, `OfWorld` the expected work of each cell in a world: in yardsticks if
  /// any cost is known, else 1. The arguments are numbers in the plan.
  double Of(std::size_t cell) const { return OfWorld(plan_.WorldOf(cell)); }
  double OfWorld(std::size_t world) const { return per_cell_[static_cast<std::size_t>(plan_.world(world).scenario)]; }
  /// Returns the expected wall time of a unit of work, seconds; 0 = unknown.
  double SecondsEach(int workers) const { return is_known_ ? kYardstickS / workers : 0; }

 private:
  const Plan& plan_;
  std::vector<double> per_cell_;  ///< by scenario
  bool is_known_ = false;
};

}  // namespace etude
