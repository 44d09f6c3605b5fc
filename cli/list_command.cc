#include <fmt/core.h>

#include "bench/recordings/task_extras.h"
#include "bench/run/suite.h"
#include "bench/scenario/keys.h"
#include "bench/scenario/scenario.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/solver_list.h"
#include "engine/base/names.h"
#include "sim/choreography/move.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

void ListTasks() {
  for (const TaskKind& kind : AllTaskKinds()) {
    fmt::print("{:<11} {}\n{:<11} headline metrics: {}\n", kind.name, kind.question, "", Join(kind.default_metrics));
    for (const KeyInfo& key : kind.method_keys) fmt::print("{:<11}   {}: {}\n", "", key.key, key.AllowedWhere());
  }
  PrintSolvers();
}

int ListClips() {
  fmt::print("Moves (builtin:*):\n");
  for (const std::string& name : BuiltinMoveNames()) {
    const auto move = LoadBuiltinMove(name);
    if (!move) return Complain(move.error());
    fmt::print("  builtin:{:<14} {:g} beats at {:g} ({:g}…{:g}) per minute, {:.1f} s, {} key poses\n", name,
               move->beats, move->tempo_bpm, move->slowest_bpm, move->fastest_bpm, move->motion.DurationSeconds(),
               move->key_poses.size());
  }
  fmt::print("Acts of the coach (builtin:acts); builtin:slow_MOVE is a move shown slowly:\n");
  for (const std::string& name : BuiltinActNames()) {
    const auto act = LoadBuiltinMove(name);
    if (!act) return Complain(act.error());
    fmt::print("  builtin:{:<14} {:.1f} s{}\n", name, act->motion.DurationSeconds(), act->loops ? "" : ", once");
  }
  fmt::print("Songs (builtin:songs):\n");
  for (const std::string& name : BuiltinSongNames()) {
    const auto song = LoadBuiltinSong(name);
    if (!song) return Complain(song.error());
    fmt::print("  builtin:{:<14} {} moves at {:g} per minute, {:.0f} s\n", name, song->parts.size(), song->tempo_bpm,
               song->motion.DurationSeconds());
  }
  fmt::print("Your own: BVH, glTF and DeepMimic files, 'dance.glb#Jump', patterns such as '~/mocap/*.bvh' (docs/clips.md).\n");
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

int ListKeysCommand(KeysFormat format) {
  if (format != KeysFormat::kText) {
    fmt::print("{}", format == KeysFormat::kSchema ? KeysAsSchema() : KeysAsMarkdown());
    return kSuccess;
  }
  for (const KeyGroup& group : AllKeyGroups()) {
    fmt::print("{}{}\n", group.title, group.path.empty() ? "" : ": " + group.path);
    for (const KeyInfo& key : group.keys) {
      fmt::print("  {:<22} {}\n  {:<22} {}; {}\n", key.key, key.meaning, "", key.AllowedWhere(),
                 key.IsRequired() ? "required" : "default: " + key.fallback);
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
    case Listing::kRecordings:
      fmt::print("{}", RecordingsAsMarkdown());
      return kSuccess;
    case Listing::kScenarios:
      break;
  }
  return ListScenarios(scenario_folder);
}

}  // namespace etude
