#include "bench/run/setup.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>

#include "bench/tasks/registry.h"

namespace etude {
namespace {

/// One task per condition. The task reads its own keys from the condition's mapping; what neither it nor
/// the scenario knows is refused here.
Result<std::vector<std::unique_ptr<Task>>> MakeTasks(const Scenario& scenario, const ClipLibrary& clips,
                                                     bool wants_recordings) {
  std::vector<std::unique_ptr<Task>> tasks;
  for (const Condition& condition : scenario.conditions) {
    Fields fields(condition.node, "a scenario of task " + scenario.task);
    for (const std::string& key : CommonScenarioKeys()) fields.Raw(key);
    TaskInput input{fields, scenario.methods, clips, wants_recordings};
    auto task = FindTaskKind(scenario.task)->make(input);
    if (!task) return tl::unexpected(task.error());
    if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
    tasks.push_back(std::move(*task));
  }
  return tasks;
}

}  // namespace

Json EncodeSetup(const SuiteSetup& setup) {
  Json scenarios = Json::array();
  for (const ScenarioSetup& scenario : setup.scenarios) {
    scenarios.push_back({{"file", scenario.file},
                         {"seed", scenario.seed},
                         {"trials", scenario.trials},
                         {"clips", scenario.clips},
                         {"text", scenario.text}});
  }
  return {{"suite", setup.suite}, {"seed", setup.seed}, {"scenarios", std::move(scenarios)}};
}

Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place) {
  SuiteSetup setup;
  try {
    setup.suite = json.at("suite").get<std::string>();
    setup.seed = json.at("seed").get<std::uint64_t>();
    for (const Json& scenario : json.at("scenarios")) {
      setup.scenarios.push_back({scenario.at("file").get<std::string>(), scenario.at("text").get<std::string>(),
                                 scenario.at("seed").get<std::uint64_t>(), scenario.at("trials").get<int>(),
                                 scenario.at("clips").get<std::vector<std::string>>()});
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not a suite's set-up: {}", error.what());
  }
  return setup;
}

Result<PreparedScenario> Prepare(ScenarioSetup setup) {
  PreparedScenario prepared;
  auto scenario = ParseScenario(setup.text, setup.file);
  if (!scenario) return tl::unexpected(scenario.error());
  prepared.scenario_ = std::move(*scenario);
  prepared.scenario_.trials = setup.trials;
  auto clips = LoadClips(setup.clips, {setup.file, 0, 0});
  if (!clips) return tl::unexpected(clips.error());
  prepared.clips_ = std::make_unique<ClipLibrary>(std::move(*clips));
  prepared.setup_ = std::move(setup);
  auto tasks = MakeTasks(prepared.scenario_, *prepared.clips_, false);
  if (!tasks) return tl::unexpected(tasks.error());
  prepared.tasks_ = std::move(*tasks);
  if (!prepared.scenario_.recordings.trials.empty()) {
    auto recording = MakeTasks(prepared.scenario_, *prepared.clips_, true);
    if (!recording) return tl::unexpected(recording.error());
    prepared.recording_tasks_ = std::move(*recording);
  }
  return prepared;
}

bool PreparedScenario::WantsRecording(int trial) const {
  const std::vector<int>& wanted = scenario_.recordings.trials;
  return std::find(wanted.begin(), wanted.end(), trial) != wanted.end();
}

Row PreparedScenario::IdentityOf(int condition, int trial, std::size_t method) const {
  const WorldKey key{setup_.seed, scenario_.name, trial};
  Row row;
  row.scenario = scenario_.name;
  row.task = scenario_.task;
  row.condition = scenario_.conditions[condition].settings;
  row.trial = trial;
  row.clip = tasks_[condition]->ClipOf(key);
  row.method = scenario_.method_names[method];
  return row;
}

std::vector<Row> PreparedScenario::RunWorld(int condition, int trial) const {
  const WorldKey key{setup_.seed, scenario_.name, trial};
  const bool recording = WantsRecording(trial);
  std::vector<CellResult> results;
  try {
    results = (recording ? recording_tasks_ : tasks_)[condition]->RunWorld(key);
  } catch (const std::exception& error) {
    return RowsWithoutResult(condition, trial, Status::kFailed, std::string("the task threw: ") + error.what());
  }
  if (results.size() != scenario_.methods.size()) {
    return RowsWithoutResult(condition, trial, Status::kBadOutput,
                             fmt::format("{} results for {} methods", results.size(), scenario_.methods.size()));
  }
  std::vector<Row> rows;
  const std::vector<std::string>& keep = scenario_.recordings.methods;
  for (std::size_t m = 0; m < results.size(); ++m) {
    Row row = IdentityOf(condition, trial, m);
    row.result = std::move(results[m]);
    const bool kept = recording && std::find(keep.begin(), keep.end(), row.method) != keep.end();
    if (!kept) row.result.recording.reset();
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> PreparedScenario::RowsWithoutResult(int condition, int trial, Status status,
                                                     const std::string& reason) const {
  std::vector<Row> rows;
  for (std::size_t m = 0; m < scenario_.methods.size(); ++m) {
    Row row = IdentityOf(condition, trial, m);
    row.result = CellResult::Ended(status, reason);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace etude
