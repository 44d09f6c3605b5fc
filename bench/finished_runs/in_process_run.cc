#include "bench/finished_runs/in_process_run.h"

#include "bench/finished_runs/finish_scenario.h"
#include "bench/run/cell_runner.h"
#include "bench/run/outside_programs.h"

namespace etude {
namespace {

constexpr const char* kBuiltInName = "built in";

// Fast, with metrics of every kind: medians, a share, a count. The changes are real ones, from hardly any to a
// large one: joints may not turn further from a start that is 15° (standard deviation) off.
constexpr const char* kBuiltInScenario = R"(
scenario: gate-self-test
question: Does the gate see what it should, and nothing else?
task: ik
trials: 30
sweep: {joint_noise_deg: [5, 15]}
max_sweeps: 60
methods:
  - {name: reference,     solver: damped-least-squares}
  - {name: within-40-deg, solver: damped-least-squares, tolerance_deg: 40}
  - {name: within-36-deg, solver: damped-least-squares, tolerance_deg: 36}
  - {name: within-30-deg, solver: damped-least-squares, tolerance_deg: 30}
metrics: [orientation_error_deg, position_error_cm, hidden_angle_error_deg, solved_practical, iterations]
)";

}  // namespace

Result<Rehearsal> ReadRehearsal(const std::string& file, std::optional<int> trials) {
  Rehearsal rehearsal;
  rehearsal.setup.file = file.empty() ? kBuiltInName : file;
  if (file.empty()) rehearsal.sources[kBuiltInName] = kBuiltInScenario;
  ASSIGN_OR_RETURN(auto scenarios, file.empty() ? ParseScenarios(kBuiltInName, rehearsal.sources)
                                                : ReadScenarios(file, rehearsal.sources));
  Scenario& scenario = scenarios.front();
  rehearsal.setup.name = scenario.name;
  rehearsal.setup.trials = trials.value_or(scenario.trials);
  rehearsal.setup.clips = scenario.clips;
  rehearsal.setup.libraries = scenario.libraries;
  scenario.trials = rehearsal.setup.trials;
  rehearsal.scenario = std::move(scenario);
  return rehearsal;
}

Result<FinishedRun> RunInProcess(const Rehearsal& rehearsal, std::uint64_t seed) {
  ScenarioSetup setup = rehearsal.setup;
  setup.seed = seed;
  ASSIGN_OR_RETURN(
      const auto prepared,
      Prepare(SuiteSetup{.suite = "", .seed = seed, .sources = rehearsal.sources, .scenarios = {}, .scored = {}}, setup,
              rehearsal.scenario));
  const Scenario& scenario = prepared.scenario();
  FinishedRun run;
  run.data.suite = scenario.name;
  run.data.seed = seed;
  run.scenarios.push_back(FinishScenario(scenario, setup, {}));
  CellRunner runner(prepared, "", FenceFor({&prepared, 1}, {}, ""));
  for (int condition = 0; condition < static_cast<int>(scenario.conditions.size()); ++condition) {
    for (int trial = 0; trial < scenario.trials; ++trial) {
      runner.Open(condition, trial);
      for (std::size_t m = 0; m < scenario.methods.size(); ++m) run.data.rows.push_back(runner.Run(m).row);
    }
  }
  return run;
}

}  // namespace etude
