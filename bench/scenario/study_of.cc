#include "bench/scenario/study_of.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "bench/keys/key_schema.h"

namespace etude {
namespace {

std::vector<std::string> StagesOf(const Node* oracle) {
  std::vector<std::string> stages;
  if (oracle == nullptr || oracle->kind != Node::Kind::kSequence) return stages;
  for (const Node& stage : oracle->items) stages.push_back(stage.scalar);
  return stages;
}

/// Of a built-in method: what its entry says but for its name and its oracle.
std::string SettingsOf(const MethodEntry& method) {
  if (!method.exec.empty()) return "";  // what a program is, nobody knows
  Node settings = method.node;
  std::erase_if(settings.entries,
                [](const Node::Entry& entry) { return entry.key == "name" || entry.key == "oracle"; });
  const auto text = WriteJson(ToJson(settings));
  return text ? *text : "";
}

}  // namespace

Study StudyOf(const Scenario& scenario) {
  Study study{.scenario = scenario.name,
              .task = scenario.task,
              .question = scenario.question,
              .unit = scenario.unit,
              .trials = scenario.trials,
              .methods = {},
              .conditions = {},
              .metrics = scenario.metrics,
              .across = scenario.across,
              .rival = scenario.rival,
              .expectations = scenario.expectations,
              .gate = scenario.gate};
  for (const MethodEntry& method : scenario.methods) {
    const Node* oracle = method.node.Find("oracle");
    const bool has_oracle = oracle != nullptr && (oracle->kind != Node::Kind::kSequence || !oracle->items.empty());
    study.methods.push_back({method.name, method.against, has_oracle, StagesOf(oracle), SettingsOf(method)});
  }
  for (const Condition& condition : scenario.conditions) study.conditions.push_back(condition.swept);
  return study;
}

}  // namespace etude
