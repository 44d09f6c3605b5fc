#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/results/json.h"
#include "bench/scenario/scenario.h"
#include "bench/tasks/base/task.h"

namespace etude {

/// All that is needed to make a scenario's worlds again, anywhere: what the manifest keeps and what
/// every worker is started with.
struct ScenarioSetup {
  std::string file;
  std::string text;
  std::uint64_t seed = 1;
  int trials = 1;
  std::vector<std::string> clips;  ///< references; the scenario's own, or those of --clips
};

struct SuiteSetup {
  std::string suite;
  std::uint64_t seed = 1;
  std::vector<ScenarioSetup> scenarios;
};

Json EncodeSetup(const SuiteSetup& setup);
Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place);

/// A scenario with its clips loaded and its tasks made: ready to run any of its worlds.
class PreparedScenario {
 public:
  const ScenarioSetup& setup() const { return setup_; }
  const Scenario& scenario() const { return scenario_; }
  const ClipLibrary& clips() const { return *clips_; }

  /// Runs the world (condition, trial): one row per method. A task that throws gives failed rows.
  std::vector<Row> RunWorld(int condition, int trial) const;
  /// The rows of a world that could not be run to its end.
  std::vector<Row> RowsWithoutResult(int condition, int trial, Status status, const std::string& reason) const;

 private:
  friend Result<PreparedScenario> Prepare(ScenarioSetup setup);
  bool WantsRecording(int trial) const;
  Row IdentityOf(int condition, int trial, std::size_t method) const;

  ScenarioSetup setup_;
  Scenario scenario_;
  std::unique_ptr<ClipLibrary> clips_;
  std::vector<std::unique_ptr<Task>> tasks_;            ///< one per condition
  std::vector<std::unique_ptr<Task>> recording_tasks_;  ///< the same, keeping motions
};

/// Reads the scenario, loads its clips and makes its tasks; every complaint about a scenario, its
/// methods or its clips comes from here.
Result<PreparedScenario> Prepare(ScenarioSetup setup);

}  // namespace etude
