#include "bench/scenario/study_of.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "io/files/json.h"

namespace etude {
namespace {

std::vector<std::string> StagesOf(const Node* oracle) {
  std::vector<std::string> stages;
  if (oracle == nullptr || oracle->kind != Node::Kind::kSequence) return stages;
  for (const Node& stage : oracle->items) stages.push_back(stage.scalar);
  return stages;
}

/// Returns the settings of a built-in method as text: its mapping without name, oracle and description.
std::string SettingsOf(const MethodEntry& method) {
  if (!method.exec.empty()) return "";  // the settings of a program are unknown
  Node settings = method.node;
  std::erase_if(settings.entries, [](const Node::Entry& entry) {
    return entry.key == "name" || entry.key == "oracle" || entry.key == "description";
  });
  const auto text = WriteJson(ToJson(settings));
  return text ? *text : "";
}

/// Returns a method's description. If it has none, returns a description made from its settings, e.g. "solver ccd,
/// weights fixed" or "a program".
std::string DescriptionOf(const MethodEntry& method) {
  if (!method.description.empty()) return method.description;
  std::string text = method.exec.empty() ? "" : "a program";
  for (const Node::Entry& entry : method.node.entries) {
    if (entry.key == "name" || entry.key == "exec" || entry.value.kind == Node::Kind::kMapping) continue;
    std::string value = entry.value.scalar;
    for (const Node& item : entry.value.items) value += (value.empty() ? "" : " and ") + item.scalar;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", entry.key, value);
  }
  return text;
}

}  // namespace

Study StudyOf(const Scenario& scenario) {
  Study study{.scenario = scenario.name,
              .task = scenario.task,
              .question = scenario.question,
              .description = scenario.description,
              .unit = scenario.unit,
              .trials = scenario.trials,
              .methods = {},
              .conditions = {},
              .metrics = scenario.metrics,
              .across = scenario.across,
              .success = scenario.success,
              .success_matters = scenario.success_matters,
              .rival = scenario.rival,
              .expectations = scenario.expectations,
              .gate = scenario.gate};
  for (const MethodEntry& method : scenario.methods) {
    const Node* oracle = method.node.Find("oracle");
    const bool has_oracle = oracle != nullptr && (oracle->kind != Node::Kind::kSequence || !oracle->items.empty());
    study.methods.push_back(
        {method.name, method.against, has_oracle, StagesOf(oracle), SettingsOf(method), DescriptionOf(method)});
  }
  // Keep the swept values of each condition only.
  for (const Condition& condition : scenario.conditions) study.conditions.push_back(condition.swept);
  return study;
}

}  // namespace etude
