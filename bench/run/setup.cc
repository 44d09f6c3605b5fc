#include "bench/run/setup.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/scenario/methods.h"
#include "bench/tasks/registry.h"

namespace etude {
namespace {

/// One task per condition. The task reads its own keys from the condition's mapping; what neither it nor
/// the scenario knows is refused here.
Result<std::vector<std::unique_ptr<Task>>> MakeTasks(const Scenario& scenario, const ClipLibrary& clips) {
  std::vector<Node> built_in;
  for (const MethodEntry& method : scenario.methods) {
    if (method.exec.empty()) built_in.push_back(method.node);
  }
  std::vector<std::unique_ptr<Task>> tasks;
  for (const Condition& condition : scenario.conditions) {
    Fields fields(condition.node, "a scenario of task " + scenario.task);
    for (const KeyInfo& key : CommonScenarioKeys()) fields.Raw(key.key);
    TaskInput input{fields, built_in, clips};
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
    scenarios.push_back({{"name", scenario.name},
                         {"file", scenario.file},
                         {"seed", scenario.seed},
                         {"trials", scenario.trials},
                         {"clips", scenario.clips},
                         {"digest", scenario.digest}});
  }
  Json sources = Json::object();
  for (const auto& [file, text] : setup.sources) sources[file] = text;
  return {{"suite", setup.suite},
          {"seed", setup.seed},
          {"scenarios", std::move(scenarios)},
          {"sources", std::move(sources)}};
}

Result<SuiteSetup> DecodeSetup(const Json& json, const Place& place) {
  SuiteSetup setup;
  try {
    setup.suite = json.at("suite").get<std::string>();
    setup.seed = json.at("seed").get<std::uint64_t>();
    for (const auto& [file, text] : json.at("sources").items()) setup.sources[file] = text.get<std::string>();
    for (const Json& scenario : json.at("scenarios")) {
      setup.scenarios.push_back({scenario.at("file").get<std::string>(), scenario.at("name").get<std::string>(),
                                 scenario.at("seed").get<std::uint64_t>(), scenario.at("trials").get<int>(),
                                 scenario.at("clips").get<std::vector<std::string>>(),
                                 scenario.at("digest").get<std::string>()});
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not a suite's set-up: {}", error.what());
  }
  return setup;
}

Result<PreparedScenario> Prepare(const ScenarioSetup& setup, const SourceTexts& sources) {
  auto scenarios = ParseScenarios(setup.file, sources);
  if (!scenarios) return tl::unexpected(scenarios.error());
  const auto named = std::find_if(scenarios->begin(), scenarios->end(),
                                  [&](const Scenario& scenario) { return scenario.name == setup.name; });
  if (named == scenarios->end()) return Fail({setup.file, 0, 0}, "holds no scenario named '{}'", setup.name);
  PreparedScenario prepared;
  prepared.scenario_ = std::move(*named);
  prepared.scenario_.trials = setup.trials;
  auto clips = LoadClips(setup.clips, {setup.file, 0, 0});
  if (!clips) return tl::unexpected(clips.error());
  prepared.clips_ = std::make_unique<ClipLibrary>(std::move(*clips));
  prepared.setup_ = setup;
  auto tasks = MakeTasks(prepared.scenario_, *prepared.clips_);
  if (!tasks) return tl::unexpected(tasks.error());
  prepared.tasks_ = std::move(*tasks);
  return prepared;
}

Result<std::vector<PreparedScenario>> PrepareAll(const SuiteSetup& suite) {
  std::vector<PreparedScenario> scenarios;
  for (const ScenarioSetup& setup : suite.scenarios) {
    auto prepared = Prepare(setup, suite.sources);
    if (!prepared) return tl::unexpected(prepared.error());
    scenarios.push_back(std::move(*prepared));
  }
  return scenarios;
}

Result<void> PreparedScenario::AddMethod(const std::string& name, bool alone) {
  if (!IsPlainName(name)) {
    return Fail({}, "'{}' is no name of a method; allowed: letters, digits, '-', '_' and '.', at most 80", name);
  }
  std::vector<MethodEntry>& methods = scenario_.methods;
  if (alone) {
    methods.clear();
    scenario_.expectations.clear();
    scenario_.gate = {};
    scenario_.recordings.methods.clear();
  }
  const bool is_taken = std::any_of(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
  if (is_taken) return Fail({setup_.file, 0, 0}, "scenario {} has a method named '{}' already", scenario_.name, name);
  MethodEntry entry;
  entry.name = name;
  entry.against = methods.empty() ? name : methods.front().name;
  methods.push_back(std::move(entry));
  if (!scenario_.recordings.trials.empty()) scenario_.recordings.methods.push_back(name);
  return {};
}

Row PreparedScenario::IdentityOf(int condition, int trial, std::size_t method) const {
  Row row;
  row.scenario = scenario_.name;
  row.task = scenario_.task;
  row.condition = scenario_.conditions[condition].settings;
  row.trial = trial;
  row.clip = tasks_[condition]->ClipOf(KeyOf(trial));
  row.method = scenario_.methods[method].name;
  return row;
}

Row PreparedScenario::EndedRow(int condition, int trial, std::size_t method, Status status,
                               const std::string& reason) const {
  Row row = IdentityOf(condition, trial, method);
  row.result = CellResult::Ended(status, reason);
  CompleteMetrics(condition, row);
  return row;
}

void PreparedScenario::CompleteMetrics(int condition, Row& row) const {
  CellResult& result = row.result;
  if (result.status == Status::kOk) return;
  for (const std::string& id : FindTaskKind(scenario_.task)->metrics) {
    const bool reported = std::any_of(result.metrics.begin(), result.metrics.end(),
                                      [&](const MetricValue& metric) { return metric.id == id; });
    if (reported) continue;
    std::optional<double> value;
    if (result.status != Status::kSkipped) value = tasks_[condition]->ValueOfFailure(id);
    if (value) {
      result.Measure(id, *value);
    } else {
      result.Missing(id, result.reason);
    }
  }
}

}  // namespace etude
