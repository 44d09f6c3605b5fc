#include "bench/outside/specimens.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "bench/tasks/registry.h"
#include "engine/base/names.h"
#include "engine/document/node.h"

namespace etude {
namespace {

constexpr int kProblems = 3;

/// What worlds a task's specimens are made of: easy ones, and harder ones.
struct Recipe {
  const char* task;
  std::vector<std::string> clips;
  std::array<const char*, 2> conditions;
};

const std::vector<Recipe>& Recipes() {
  static const std::vector<Recipe> recipes = {
      {"transition", {"builtin:clap", "builtin:sway", "builtin:boxing"}, {"{wait_s: 1}", "{wait_s: 3}"}},
      {"detection", {"builtin:clap", "builtin:sway"}, {"{events: 4}", "{events: 8, noise: 2}"}},
      {"ik", {}, {"{joint_noise_deg: 5}", "{joint_noise_deg: 15}"}},
      {"tracking", {"builtin:clap"}, {"{duration_s: 0.2}", "{duration_s: 0.4, rate_hz: 15}"}},
      {"pose-distance",
       {"builtin:clap", "builtin:sway"},
       {"{pairs: blindspots}", "{pairs: frames, pairs_per_world: 5}"}},
      {"search",
       {"builtin:clap", "builtin:sway"},
       {"{frames: 500, queries: 5}", "{frames: 500, queries: 5, query: within}"}},
      {"capture", {"builtin:clap"}, {"{duration_s: 0.1}", "{duration_s: 0.1, clothes: everyday}"}},
      {"coach", {}, {"{session_s: 10, people: adult}", "{session_s: 12, people: adult, noise: 2, song: sprint}"}}};
  return recipes;
}

Result<Specimen> MakeSpecimen(const TaskKind& kind, const Recipe& recipe, const std::string& condition,
                              const std::string& seat) {
  Specimen specimen;
  specimen.setting_id = kind.name + " " + condition;
  ASSIGN_OR_RETURN(auto clips, LoadClips(recipe.clips, {}));
  specimen.clips = std::make_unique<ClipLibrary>(std::move(clips));
  ASSIGN_OR_RETURN(const auto node, ParseYaml(condition, specimen.setting_id));
  Fields fields(node, "a specimen of task " + kind.name);
  std::vector<Node> methods;
  if (!seat.empty()) {
    ASSIGN_OR_RETURN(methods.emplace_back(), ParseYaml("{name: specimen, seat: " + seat + "}", specimen.setting_id));
  }
  TaskInput input{fields, methods, *specimen.clips};
  ASSIGN_OR_RETURN(auto task, kind.make(input));
  specimen.task = std::move(task);
  ASSIGN_OR_RETURN(auto setting, specimen.task->Setting());
  specimen.setting = std::move(setting);
  for (int trial = 0; trial < kProblems; ++trial) {
    auto world = specimen.task->MakeWorld({1, "check-method", trial}, false);
    Payload problem;
    if (seat.empty()) {
      ASSIGN_OR_RETURN(problem, world->MakeProblem());
    }
    specimen.problems.push_back(
        {fmt::format("{} {}", specimen.setting_id, trial), std::move(world), std::move(problem)});
  }
  return specimen;
}

}  // namespace

Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat) {
  std::vector<std::string> known;
  for (const Recipe& recipe : Recipes()) known.push_back(recipe.task);
  const TaskKind* kind = FindTaskKind(task);
  if (kind == nullptr) return Fail({}, "{}", UnknownName("task", task, known));
  if (kind->seats.empty() && !seat.empty()) return Fail({}, "task {} has no seats", task);
  if (seat.empty() && !kind->has_problems) {
    return Fail({}, "task {} needs a seat: {}", task, fmt::join(kind->seats, ", "));
  }
  if (!seat.empty() && std::ranges::find(kind->seats, seat) == kind->seats.end()) {
    return Fail({}, "{}", UnknownName("seat", seat, kind->seats));
  }
  std::vector<Specimen> specimens;
  for (const Recipe& recipe : Recipes()) {
    if (recipe.task != task) continue;
    for (const char* condition : recipe.conditions) {
      ASSIGN_OR_RETURN(auto specimen, MakeSpecimen(*kind, recipe, condition, seat));
      specimens.push_back(std::move(specimen));
    }
  }
  return specimens;
}

}  // namespace etude
