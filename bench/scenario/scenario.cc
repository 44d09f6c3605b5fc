#include "bench/scenario/scenario.h"

#include <algorithm>
#include <cmath>

#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "bench/scenario/sources.h"
#include "bench/scenario/sweep.h"
#include "bench/tasks/registry.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr int kMostTrials = 1'000'000;

RecordingSelection ReadVideo(Fields& fields, const Scenario& scenario) {
  RecordingSelection selection;
  const Node* node = fields.Raw("video");
  if (node == nullptr) return selection;
  Fields video(*node, "'video'");
  const std::vector<std::string> names = MethodNames(scenario);
  const Node* methods = video.Raw("compare");
  selection.methods = video.Texts("compare");
  for (std::size_t i = 0; video.ok() && i < selection.methods.size(); ++i) {
    if (std::find(names.begin(), names.end(), selection.methods[i]) == names.end()) {
      video.Complain(methods->items[i].place, UnknownName("method", selection.methods[i], names));
    }
  }
  const Node* trials = video.Raw("trials");
  for (double trial : video.Numbers("trials", {0, scenario.trials - 1.0})) {
    if (trial != std::floor(trial)) video.Complain(trials->place, "'trials' must be whole numbers");
    selection.trials.push_back(static_cast<int>(trial));
  }
  if (selection.trials.empty()) selection.trials = {0};
  if (selection.methods.empty()) selection.methods = names;
  if (auto done = video.Finish(); !done) fields.Complain(done.error().place, done.error().message);
  return selection;
}

Limits ReadLimits(Fields& fields) {
  Limits limits;
  const Node* node = fields.Raw("limits");
  if (node == nullptr) return limits;
  Fields entry(*node, "'limits'");
  limits.time_s = entry.Number("time_s", limits.time_s, {0.001, 86'400});
  limits.memory_mb = entry.Number("memory_mb", limits.memory_mb, {16, 1'048'576});
  if (auto done = entry.Finish(); !done) fields.Complain(done.error().place, done.error().message);
  return limits;
}

const TaskKind* ReadTask(Fields& fields) {
  std::vector<std::string> kinds;
  for (const TaskKind& kind : AllTaskKinds()) kinds.push_back(kind.name);
  fields.RequiredText("task");
  return FindTaskKind(fields.Choice("task", kinds, kinds.front()));
}

Result<Scenario> ParseScenario(const Node& node, const std::string& file) {
  Fields fields(node, "a scenario");
  Scenario scenario;
  scenario.file = file;
  scenario.name = ReadPlainName(fields, "scenario");
  scenario.question = fields.RequiredText("question");
  const TaskKind& kind = *ReadTask(fields);
  scenario.task = kind.name;
  scenario.clips = fields.Texts("clips");
  scenario.joint_map = fields.Text("joint_map", "");
  scenario.trials = fields.Integer("trials", 10, {1, kMostTrials});
  constexpr double kLargestSeed = 9007199254740992;  // 2^53: every whole number up to it is exact
  if (const auto seed = fields.OptionalWhole("seed", {0, kLargestSeed})) {
    scenario.seed = static_cast<std::uint64_t>(*seed);
  }
  scenario.limits = ReadLimits(fields);
  if (fields.ok()) scenario.methods = ReadMethods(fields, kind);
  for (const KeyInfo& key : kind.condition_keys) fields.Raw(key.key);
  if (fields.ok()) scenario.conditions = ReadSweep(fields, kind);
  if (fields.ok()) scenario.metrics = ReadMetrics(fields, kind);
  if (fields.ok()) scenario.expectations = ReadExpectations(fields, scenario, kind);
  if (fields.ok()) scenario.recordings = ReadVideo(fields, scenario);
  if (fields.ok()) scenario.gate = ReadGate(fields, scenario, kind);
  RETURN_IF_ERROR(fields.Finish());
  return scenario;
}

}  // namespace

std::vector<std::string> MethodNames(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const MethodEntry& method : scenario.methods) names.push_back(method.name);
  return names;
}

Result<std::vector<Scenario>> ParseScenarios(const std::string& file, const SourceTexts& texts) {
  const auto from_texts = [&](const std::string& path, const Place& asked_at) -> Result<std::string> {
    const auto text = texts.find(path);
    if (text == texts.end()) return Fail(asked_at, "the text of '{}' is missing", path);
    return text->second;
  };
  ASSIGN_OR_RETURN(const auto nodes, CollectScenarios(file, from_texts));
  std::vector<Scenario> scenarios;
  std::size_t values = 0;
  for (const Node& node : nodes) {
    ASSIGN_OR_RETURN(auto scenario, ParseScenario(node, file));
    values += scenario.conditions.size() * CountValues(node);
    if (values > kMostValues) {
      return Fail(node.place, "with this scenario, the conditions of the file hold more than {} values", kMostValues);
    }
    for (const Scenario& other : scenarios) {
      if (other.name != scenario.name) continue;
      return Fail(node.Find("scenario")->place, "two scenarios of this file are named '{}'", other.name);
    }
    scenarios.push_back(std::move(scenario));
  }
  return scenarios;
}

}  // namespace etude
