#pragma once

#include <string>
#include <vector>

#include "bench/outside/outside_method.h"
#include "bench/run/setup.h"

namespace etude {

/// The metrics of a scenario that other programs measure, each by a process of its own, which is started at its first
/// cell and kept. They are told what a recording of the cell holds, truth among it; methods never are.
class OutsideMetrics {
 public:
  /// Takes what CellRunner takes. The scenario must outlive it.
  OutsideMetrics(const PreparedScenario& scenario, const std::string& error_folder, const Fence& fence);

  bool empty() const { return programs_.empty(); }
  /// Adds every metric's value of a cell that has its recording, or why there is none; a cell without one has none of
  /// them. Returns what of this machine kept a program from being asked; "" = nothing did.
  std::string Measure(const std::string& cell, CellResult& result);
  /// Puts every test vector. Fails at the first whose value is another, with what was expected and found.
  Result<void> CheckVectors();

 private:
  OutsideReply Ask(std::size_t metric, const std::string& id, const Payload& cell);

  const PreparedScenario& scenario_;
  std::vector<OutsideMethod> programs_;  ///< by metric
  std::vector<Payload> settings_;
};

/// Checks the test vectors of all scenarios' metrics.
Result<void> CheckMetricVectors(std::span<const PreparedScenario> scenarios, const Fence& fence);

/// The standard error of a program that a scenario starts goes to this file in `folder`; "" = to ours. Programs of one
/// scenario differ in name.
std::string ErrorFileOf(const std::string& folder, const Scenario& scenario, const std::string& program);

}  // namespace etude
