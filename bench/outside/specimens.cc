#include "bench/outside/specimens.h"

#include <array>
#include <nlohmann/json.hpp>

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
      {"capture", {"builtin:clap"}, {"{duration_s: 0.1}", "{duration_s: 0.1, clothes: everyday}"}}};
  return recipes;
}

Result<Specimen> MakeSpecimen(const TaskKind& kind, const Recipe& recipe, const std::string& condition) {
  Specimen specimen;
  specimen.setting_id = kind.name + " " + condition;
  auto clips = LoadClips(recipe.clips, {});
  if (!clips) return tl::unexpected(clips.error());
  specimen.clips = std::make_unique<ClipLibrary>(std::move(*clips));
  const auto node = ParseYaml(condition, specimen.setting_id);
  if (!node) return tl::unexpected(node.error());
  Fields fields(*node, "a specimen of task " + kind.name);
  TaskInput input{fields, {}, *specimen.clips};
  auto task = kind.make(input);
  if (!task) return tl::unexpected(task.error());
  specimen.task = std::move(*task);
  auto setting = specimen.task->Setting();
  if (!setting) return tl::unexpected(setting.error());
  specimen.setting = std::move(*setting);
  for (int trial = 0; trial < kProblems; ++trial) {
    auto world = specimen.task->MakeWorld({1, "check-method", trial}, false);
    auto problem = world->MakeProblem();
    if (!problem) return tl::unexpected(problem.error());
    specimen.problems.push_back(
        {fmt::format("{} {}", specimen.setting_id, trial), std::move(world), std::move(*problem)});
  }
  return specimen;
}

}  // namespace

Result<std::vector<Specimen>> MakeSpecimens(const std::string& task) {
  std::vector<std::string> known;
  for (const Recipe& recipe : Recipes()) known.push_back(recipe.task);
  const TaskKind* kind = FindTaskKind(task);
  if (kind == nullptr) return Fail({}, "{}", UnknownName("task", task, known));
  std::vector<Specimen> specimens;
  for (const Recipe& recipe : Recipes()) {
    if (recipe.task != task) continue;
    for (const char* condition : recipe.conditions) {
      auto specimen = MakeSpecimen(*kind, recipe, condition);
      if (!specimen) return tl::unexpected(specimen.error());
      specimens.push_back(std::move(*specimen));
    }
  }
  return specimens;
}

}  // namespace etude
