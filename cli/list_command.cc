#include <fmt/core.h>

#include "bench/files/files.h"
#include "bench/metrics/catalogue.h"
#include "bench/run/suite.h"
#include "bench/scenario/scenario.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "engine/base/names.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

void ListMetrics() {
  for (const MetricInfo& metric : AllMetrics()) {
    fmt::print("{:<26} v{}  {:<16}  {}\n", metric.id, metric.version, DirectionWords(metric.direction),
               metric.definition);
  }
}

void ListTasks() {
  for (const TaskKind& kind : AllTaskKinds()) {
    fmt::print("{:<11} {}\n{:<11} headline metrics: {}\n", kind.name, kind.question, "", Join(kind.default_metrics));
    for (const auto& [key, values] : kind.method_keys) fmt::print("{:<11}   {}: {}\n", "", key, values);
  }
}

int ListClips() {
  for (const std::string& name : BuiltinMoveNames()) {
    const auto move = LoadBuiltinMove(name);
    if (!move) return Complain(move.error());
    fmt::print("builtin:{:<14} {:g} beats at {:g} per minute, {:.1f} s, {} key poses\n", name, move->beats,
               move->tempo_bpm, move->motion.DurationSeconds(), move->key_poses.size());
  }
  fmt::print("Your own: a .bvh file, or a pattern such as '~/mocap/*.bvh'.\n");
  return kSuccess;
}

int ListScenarios(const std::string& folder) {
  const auto files = FindScenarioFiles({folder});
  if (!files) return Complain(files.error());
  for (const std::string& file : *files) {
    auto text = ReadWholeFile(file);
    if (!text) return Complain(text.error());
    const auto scenario = ParseScenario(*text, file);
    if (!scenario) return Complain(scenario.error());
    fmt::print("{}\n  {} ({}): {}\n  {} trials × {} conditions × methods {}\n", file, scenario->name, scenario->task,
               scenario->question, scenario->trials, scenario->conditions.size(), Join(scenario->method_names));
  }
  return kSuccess;
}

}  // namespace

int ListCommand(Listing what, const std::string& scenario_folder) {
  switch (what) {
    case Listing::kMethods:
      ListTasks();
      return kSuccess;
    case Listing::kMetrics:
      ListMetrics();
      return kSuccess;
    case Listing::kClips:
      return ListClips();
    case Listing::kScenarios:
      break;
  }
  return ListScenarios(scenario_folder);
}

}  // namespace etude
