#include <fmt/core.h>

#include "bench/run/suite.h"
#include "bench/scenario/keys.h"
#include "bench/scenario/scenario.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "engine/base/names.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

void ListTasks() {
  for (const TaskKind& kind : AllTaskKinds()) {
    fmt::print("{:<11} {}\n{:<11} headline metrics: {}\n", kind.name, kind.question, "", Join(kind.default_metrics));
    for (const KeyInfo& key : kind.method_keys) fmt::print("{:<11}   {}: {}\n", "", key.key, key.allowed);
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
    SourceTexts texts;
    if (auto read = ReadSources(file, texts); !read) return Complain(read.error());
    const auto scenarios = ParseScenarios(file, texts);
    if (!scenarios) return Complain(scenarios.error());
    fmt::print("{}\n", file);
    for (const Scenario& scenario : *scenarios) {
      fmt::print("  {} ({}): {}\n  {} trials × {} conditions × methods {}\n", scenario.name, scenario.task,
                 scenario.question, scenario.trials, scenario.conditions.size(), Join(MethodNames(scenario)));
    }
  }
  return kSuccess;
}

}  // namespace

int ListKeysCommand(bool as_markdown) {
  if (as_markdown) {
    fmt::print("{}", KeysAsMarkdown());
    return kSuccess;
  }
  for (const KeyGroup& group : AllKeyGroups()) {
    fmt::print("{}{}\n", group.title, group.path.empty() ? "" : ": " + group.path);
    for (const KeyInfo& key : group.keys) {
      fmt::print("  {:<22} {}\n  {:<22} {}; {}\n", key.key, key.meaning, "", key.allowed,
                 key.fallback.empty() ? "required" : "default: " + key.fallback);
    }
    fmt::print("\n");
  }
  fmt::print("Methods, metrics and clips: etude list methods, etude list metrics, etude list clips.\n");
  return kSuccess;
}

int ListCommand(Listing what, const std::string& scenario_folder) {
  switch (what) {
    case Listing::kMethods:
      ListTasks();
      return kSuccess;
    case Listing::kClips:
      return ListClips();
    case Listing::kScenarios:
      break;
  }
  return ListScenarios(scenario_folder);
}

}  // namespace etude
