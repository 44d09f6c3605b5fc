#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/metrics/catalogue.h"
#include "bench/metrics/export.h"
#include "bench/recordings/task_extras.h"
#include "bench/run/costs.h"
#include "bench/run/shipped.h"
#include "bench/run/suite.h"
#include "bench/scenario/keys.h"
#include "bench/scenario/scenario.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "engine/base/names.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/motion/motion_faults.h"
#include "sim/choreography/move.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

void PrintSolvers() {
  fmt::print("Solvers of inverse kinematics:\n");
  for (const IkSolver& solver : AllIkSolvers()) fmt::print("  {:<20}  {}\n", solver.name, solver.description);
}

Json TasksAsJson() {
  Json tasks = Json::array(), solvers = Json::array();
  for (const TaskKind& kind : AllTaskKinds()) {
    Json keys = Json::array();
    for (const KeyInfo& key : kind.method_keys) keys.push_back({{"key", key.key}, {"allowed", key.AllowedWhere()}});
    tasks.push_back({{"task", kind.name},
                     {"question", kind.question},
                     {"headline_metrics", kind.default_metrics},
                     {"keys", std::move(keys)}});
  }
  for (const IkSolver& solver : AllIkSolvers()) {
    solvers.push_back({{"solver", solver.name}, {"description", solver.description}});
  }
  return {{"tasks", std::move(tasks)}, {"solvers", std::move(solvers)}};
}

void ListTasks() {
  for (const TaskKind& kind : AllTaskKinds()) {
    fmt::print("{:<11} {}\n{:<11} headline metrics: {}\n", kind.name, kind.question, "", Join(kind.default_metrics));
    for (const KeyInfo& key : kind.method_keys) fmt::print("{:<11}   {}: {}\n", "", key.key, key.AllowedWhere());
  }
  PrintSolvers();
}

Result<Json> ClipsAsJson() {
  Json moves = Json::array(), acts = Json::array(), songs = Json::array();
  for (const std::string& name : BuiltinMoveNames()) {
    ASSIGN_OR_RETURN(const auto move, LoadBuiltinMove(name));
    moves.push_back({{"clip", "builtin:" + name},
                     {"duration_s", move.motion.DurationSeconds()},
                     {"beats", move.beats},
                     {"tempo_bpm", move.tempo_bpm},
                     {"key_poses", move.key_poses.size()}});
  }
  for (const std::string& name : BuiltinActNames()) {
    ASSIGN_OR_RETURN(const auto act, LoadBuiltinMove(name));
    acts.push_back({{"clip", "builtin:" + name}, {"duration_s", act.motion.DurationSeconds()}});
  }
  for (const std::string& name : BuiltinSongNames()) {
    ASSIGN_OR_RETURN(const auto song, LoadBuiltinSongOutline(name));
    songs.push_back({{"clip", "builtin:" + name},
                     {"duration_s", static_cast<double>(song.CountFrames()) / kJudgedRateHz},
                     {"tempo_bpm", song.tempo_bpm}});
  }
  return Json{{"moves", std::move(moves)}, {"acts", std::move(acts)}, {"songs", std::move(songs)}};
}

Result<int> ListClips() {
  fmt::print("Moves (builtin:*):\n");
  for (const std::string& name : BuiltinMoveNames()) {
    ASSIGN_OR_RETURN(const auto move, LoadBuiltinMove(name));
    fmt::print("  builtin:{:<14} {:g} beats at {:g} (range {:g}…{:g}) per minute, {:.1f} s, {} key poses\n", name,
               move.beats, move.tempo_bpm, move.slowest_bpm, move.fastest_bpm, move.motion.DurationSeconds(),
               move.key_poses.size());
  }
  fmt::print("Gestures of the coach (builtin:acts); builtin:slow_MOVE shows a move slowly:\n");
  for (const std::string& name : BuiltinActNames()) {
    ASSIGN_OR_RETURN(const auto act, LoadBuiltinMove(name));
    fmt::print("  builtin:{:<14} {:.1f} s{}\n", name, act.motion.DurationSeconds(), act.loops ? "" : ", played once");
  }
  fmt::print("Songs (builtin:songs):\n");
  for (const std::string& name : BuiltinSongNames()) {
    ASSIGN_OR_RETURN(const auto song, LoadBuiltinSongOutline(name));
    fmt::print("  builtin:{:<14} {} moves at {:g} per minute, {:.0f} s\n", name, song.parts.size(), song.tempo_bpm,
               static_cast<double>(song.CountFrames()) / kJudgedRateHz);
  }
  fmt::print(
      "Your own clips: motion files (docs/clips.md lists the formats), 'dance.glb#Jump', patterns such as "
      "'~/mocap/*.bvh'.\n");
  return kSuccess;
}

/// Returns, as JSON, the scenarios in a folder; without a folder, the scenarios that come with the program, by name.
Result<Json> ScenariosAsJson(const std::string& folder) {
  std::vector<std::string> names = ShippedScenarios();
  if (!folder.empty()) {
    ASSIGN_OR_RETURN(names, FindScenarioFiles({folder}));
  }
  Json list = Json::array();
  for (const std::string& name : names) {
    SourceTexts texts;
    ASSIGN_OR_RETURN(const auto scenarios, ReadScenarios(folder.empty() ? FindShipped(name).string() : name, texts));
    for (const Scenario& scenario : scenarios) {
      list.push_back({{"name", name},
                      {"scenario", scenario.name},
                      {"task", scenario.task},
                      {"question", scenario.question},
                      {"trials", scenario.trials},
                      {"conditions", scenario.conditions.size()},
                      {"methods", MethodNames(scenario)},
                      {"work", WorkOf(scenario)}});
    }
  }
  return Json{{"scenarios", std::move(list)}};
}

/// Lists the scenarios that come with the program, one per line, by the names that `etude run` takes.
Result<int> ListShippedScenarios() {
  const std::vector<std::string> names = ShippedScenarios();
  if (names.empty())
    return Fail({},
                "this program was installed without scenarios; `etude list scenarios FOLDER` lists your own scenarios");
  for (const std::string& name : names) {
    SourceTexts texts;
    ASSIGN_OR_RETURN(const auto scenarios, ReadScenarios(FindShipped(name).string(), texts));
    for (const Scenario& scenario : scenarios) {
      fmt::print("{:<28}  {:<10}  {}\n", &scenario == &scenarios.front() ? name : "", scenario.task, scenario.question);
    }
  }
  fmt::print(
      "\n"
      "Suites: quick (takes a minute), paper (tests the claims of the papers), full (minutes to an hour per "
      "scenario).\n"
      "Examples: etude run quick; etude scenario copy full/ik_weights .\n");
  return kSuccess;
}

Result<int> ListScenarios(const std::string& folder) {
  if (folder.empty()) return ListShippedScenarios();
  ASSIGN_OR_RETURN(const auto files, FindScenarioFiles({folder}));
  for (const std::string& file : files) {
    SourceTexts texts;
    ASSIGN_OR_RETURN(const auto scenarios, ReadScenarios(file, texts));
    fmt::print("{}\n", file);
    for (const Scenario& scenario : scenarios) {
      const bool is_of_files = FindTaskKind(scenario.task)->find_files != nullptr;
      fmt::print("  {} ({}): {}\n  {} × {} × methods {}\n", scenario.name, scenario.task, scenario.question,
                 is_of_files ? "one trial per file" : CountOf(static_cast<std::size_t>(scenario.trials), "trial"),
                 CountOf(scenario.conditions.size(), "condition"), Join(MethodNames(scenario)));
    }
  }
  return kSuccess;
}

enum class Listing { kMethods, kScenarios, kClips, kRecordings, kFaults };

Result<int> ListAsJson(Listing what, const std::string& scenario_folder) {
  if (what == Listing::kMethods) {
    RETURN_IF_ERROR(PrintFacts("list methods", TasksAsJson()));
    return kSuccess;
  }
  const bool is_clips = what == Listing::kClips;
  ASSIGN_OR_RETURN(auto facts, is_clips ? ClipsAsJson() : ScenariosAsJson(scenario_folder));
  RETURN_IF_ERROR(PrintFacts(is_clips ? "list clips" : "list scenarios", std::move(facts)));
  return kSuccess;
}

Result<int> ListCommand(Listing what, const std::string& scenario_folder) {
  switch (what) {
    case Listing::kMethods:
      ListTasks();
      return kSuccess;
    case Listing::kClips:
      return ListClips();
    case Listing::kRecordings:
      fmt::print("{}", RecordingsAsMarkdown());
      return kSuccess;
    case Listing::kFaults:
      for (const FaultRule& rule : FaultRules()) fmt::print("{:<10} {}\n", rule.name, rule.rule);
      return kSuccess;
    case Listing::kScenarios:
      break;
  }
  return ListScenarios(scenario_folder);
}

enum class KeysFormat {
  kText,      ///< a text for people at a terminal
  kMarkdown,  ///< the page docs/reference/keys.md
  kSchema,    ///< the schema docs/schemas/scenario.schema.json
};

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
  fmt::print(
      "For methods, metrics and clips, see `etude list methods`, `etude list metrics` and `etude list clips`.\n");
  return kSuccess;
}

enum class MetricsFormat {
  kTable,     ///< one line for each metric, for people at a terminal
  kJson,      ///< complete definitions with test vectors (docs/schemas/metrics.schema.json)
  kMarkdown,  ///< the page docs/reference/metrics.md
};

int PrintTable() {
  for (const MetricInfo& metric : AllMetrics()) {
    fmt::print("{:<26} v{}  {:<16}  {}\n", metric.id, metric.version, DirectionWords(metric.direction),
               metric.definition);
  }
  return kSuccess;
}

Result<int> ListMetricsCommand(MetricsFormat format) {
  if (format == MetricsFormat::kTable) return PrintTable();
  if (format == MetricsFormat::kJson) {
    RETURN_IF_ERROR(PrintFacts("list metrics", MetricsJson()));
    return kSuccess;
  }
  fmt::print("{}", MetricsPage());
  return kSuccess;
}

}  // namespace

void DefineList(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("list", "List methods, metrics, clips, keys and scenarios");
  command->require_subcommand(1);
  // Define the lists that have no further options.
  const auto list = [&](const char* name, const char* help, Listing what) {
    CLI::App* listing = command->add_subcommand(name, help);
    auto as_json = std::make_shared<bool>(false);
    if (what == Listing::kMethods || what == Listing::kClips) AddJson(*listing, *as_json);
    listing->callback(
        [=, &action] { action = [=] { return Finish(*as_json ? ListAsJson(what, "") : ListCommand(what, "")); }; });
  };
  list("methods", "List tasks, the scenario keys of their methods, and solvers of inverse kinematics",
       Listing::kMethods);
  list("clips", "List built-in clips", Listing::kClips);
  list("recordings", "Print the page docs/reference/recordings.md: which data recordings contain besides motions",
       Listing::kRecordings);
  list("faults", "List the faults that `etude evaluate --alone` finds, with their thresholds", Listing::kFaults);
  // Define the list of metrics: text, JSON or Markdown.
  auto json = std::make_shared<bool>(false), markdown = std::make_shared<bool>(false);
  CLI::App* metrics = command->add_subcommand("metrics", "List metrics with their definitions");
  CLI::Option* as_json =
      metrics->add_flag("--json", *json, "Print JSON with the test vectors (docs/schemas/metrics.schema.json)");
  metrics->add_flag("--markdown", *markdown, "Print the page docs/reference/metrics.md")->excludes(as_json);
  metrics->callback([=, &action] {
    const MetricsFormat format = *json       ? MetricsFormat::kJson
                                 : *markdown ? MetricsFormat::kMarkdown
                                             : MetricsFormat::kTable;
    action = [=] { return Finish(ListMetricsCommand(format)); };
  });
  // Define the list of keys of scenario files: text, Markdown or JSON Schema.
  auto as_page = std::make_shared<bool>(false), as_schema = std::make_shared<bool>(false);
  CLI::App* keys = command->add_subcommand("keys", "List all keys of scenario files");
  CLI::Option* page = keys->add_flag("--markdown", *as_page, "Print the page docs/reference/keys.md");
  keys->add_flag("--schema", *as_schema,
                 "Print the JSON Schema of scenario files (docs/schemas/scenario.schema.json), for editors")
      ->excludes(page);
  keys->callback([=, &action] {
    const KeysFormat format = *as_schema ? KeysFormat::kSchema : *as_page ? KeysFormat::kMarkdown : KeysFormat::kText;
    action = [=] { return ListKeysCommand(format); };
  });
  // Define the list of scenarios: the scenarios of the program, or the scenarios in a folder.
  auto folder = std::make_shared<std::string>();
  CLI::App* scenarios =
      command->add_subcommand("scenarios", "List the scenarios that come with Etude, or the scenarios in a folder");
  scenarios->add_option("folder", *folder,
                        "A folder, a file, or the name of a scenario or suite that comes with Etude, such as quick");
  auto scenarios_json = std::make_shared<bool>(false);
  AddJson(*scenarios, *scenarios_json);
  scenarios->callback([=, &action] {
    action = [=] {
      return Finish(*scenarios_json ? ListAsJson(Listing::kScenarios, *folder)
                                    : ListCommand(Listing::kScenarios, *folder));
    };
  });
}

}  // namespace etude
