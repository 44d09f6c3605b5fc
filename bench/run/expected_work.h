#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bench/run/costs.h"
#include "bench/run/plan.h"

namespace etude {

/// The expected work of each cell of a run. The remaining time of the run is estimated from these numbers.
class ExpectedWork {
 public:
  /// `kept` are the stored costs (ReadKeptCosts). A cell of a scenario without stored cost counts as much as the other
  /// cells do on average; if no cost is known, every cell counts 1. The plan must outlive this object.
  ExpectedWork(const Plan& plan, const std::map<std::string, KeptCost>& kept);

  /// Return the expected work of one cell, by the cell's number or by its world's: in yardsticks if costs are known.
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
