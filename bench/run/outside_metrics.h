#pragma once

#include <string>
#include <vector>

#include "bench/outside/outside_method.h"
#include "bench/run/setup.h"

namespace etude {

/// Those metrics of a scenario that outside programs measure. A program is started when it must measure its first cell,
/// and keeps running. It receives the recording of the cell, including the ground truth, which outside methods never
/// receive.
class OutsideMetrics {
 public:
  /// The arguments have the same meaning as in CellRunner's constructor. The scenario must outlive this object.
  OutsideMetrics(const PreparedScenario& scenario, const std::string& error_folder, const Fence& fence);

  bool empty() const { return programs_.empty(); }
  /// Adds every metric's value, or the reason why there is none, to the result of a cell with a recording. Does nothing
  /// for a cell without a recording. If this machine could not run a program, returns the reason, else "".
  std::string Measure(const std::string& cell, CellResult& result);
  /// Lets the programs measure every test vector. Fails at the first wrong value, naming the expected and the found
  /// value.
  Result<void> CheckVectors();

 private:
  OutsideReply Ask(std::size_t metric, const std::string& id, const Payload& cell);

  const PreparedScenario& scenario_;
  std::vector<OutsideMethod> programs_;  ///< the program of each metric
  std::vector<Payload> settings_;
};

Result<void> CheckMetricVectors(std::span<const PreparedScenario> scenarios, const Fence& fence);

/// Returns the file in `folder` to which a scenario's program writes its standard error. Returns "" if `folder` is "":
/// the program then writes to Etude's standard error. Programs of one scenario must have different names.
std::string ErrorFileOf(const std::string& folder, const Scenario& scenario, const ScenarioProgram& program);

}  // namespace etude
