#include "bench/scenario/study_of.h"

namespace etude {

Study StudyOf(const Scenario& scenario) {
  Study study{.scenario = scenario.name,
              .task = scenario.task,
              .question = scenario.question,
              .unit = scenario.unit,
              .trials = scenario.trials,
              .methods = {},
              .conditions = {},
              .metrics = scenario.metrics,
              .rival = scenario.rival,
              .expectations = scenario.expectations,
              .gate = scenario.gate};
  for (const MethodEntry& method : scenario.methods) {
    const Node* oracle = method.node.Find("oracle");
    const bool has_oracle = oracle != nullptr && (oracle->kind != Node::Kind::kSequence || !oracle->items.empty());
    study.methods.push_back({method.name, method.against, has_oracle});
  }
  for (const Condition& condition : scenario.conditions) study.conditions.push_back(condition.swept);
  return study;
}

}  // namespace etude
