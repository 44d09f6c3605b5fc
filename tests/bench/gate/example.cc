#include "tests/bench/gate/example.h"

#include <gtest/gtest.h>

#include "bench/finished_runs/finished_runs.h"

namespace etude {

CellResult ExampleResult(int trial, double shift) {
  CellResult result = CellResult::Ended(Status::kOk, "");
  result.Measure("position_error_cm", 10 + trial + shift);
  result.Measure("solved_practical", trial % 2);
  return result;
}

FinishedRun ExampleRun(const MakeResult& make, const std::string& extra, const std::string& clip_digest) {
  ExampleSetting setting;
  setting.extra += extra;
  return ExampleRun(make, setting, clip_digest);
}

FinishedRun ExampleRun(const MakeResult& make, const ExampleSetting& setting, const std::string& clip_digest) {
  const SourceTexts texts = {{"s.yaml",
                              "scenario: s\nquestion: q?\ntask: ik\nsweep: {joint_noise_deg: [1, 2]}\n"
                              "methods: [{name: a, solver: ccd}, {name: b, solver: ccd}]\ntrials: " +
                                  std::to_string(setting.trials) + "\n" + setting.extra}};
  auto scenarios = ParseScenarios("s.yaml", texts);
  EXPECT_TRUE(scenarios) << ToString(scenarios.error());
  FinishedRun run;
  run.data.suite = "example";
  run.data.program_version = "1.2.3";
  ScenarioSetup setup;
  setup.name = "s";
  setup.seed = 5;
  setup.trials = setting.trials;
  run.scenarios.push_back(FinishScenario(scenarios->front(), setup, std::span(&clip_digest, 1)));
  for (const Condition& condition : scenarios->front().conditions) {
    for (int trial = 0; trial < setting.trials; ++trial) {
      for (const char* method : {"a", "b"}) {
        run.data.rows.push_back({"s", "ik", condition.swept, trial, "", {}, method, make(trial, method)});
      }
    }
  }
  run.data.scenarios.push_back({});
  run.data.scenarios.back().name = "s";
  return run;
}

}  // namespace etude
