#include "bench/scenario/keys.h"

#include <fmt/core.h>

#include "bench/scenario/scenario.h"
#include "bench/tasks/registry.h"
#include "engine/base/names.h"

namespace etude {
namespace {

KeyGroup FileKeys() {
  return {"",
          "A file of several scenarios",
          {{"scenarios", "a list of scenarios", "", "The scenarios, run in this order."},
           {"defaults", "a mapping", "{}", "Keys of every scenario here that does not write them itself."},
           {"include", "a list of files", "[]",
            "Files with more `defaults`, their names relative to this file; a single scenario may have it, too."}}};
}

std::vector<KeyInfo> ScenarioKeys() {
  std::vector<std::string> tasks;
  for (const TaskKind& kind : AllTaskKinds()) tasks.push_back(kind.name);
  return {{"scenario", "at most 80 letters, digits, '-', '_', '.'", "", "Its name, unique in a run."},
          {"question", "a text", "", "What is asked, in one sentence."},
          {"task", Join(tasks), "", "The kind of question."},
          {"clips", "a list of `builtin:NAME`, `builtin:*`, BVH and glTF files, patterns", "[]",
           "What worlds are made of; trials go through them in turn."},
          {"joint_map", "a file", "", "Teaches which joints of the clips play which roles, where names do not tell."},
          {"trials", "1…1000000", "10", "Worlds per condition."},
          {"seed", "0…2⁵³", "1", "Of all worlds; `etude run --seed` wins over it."},
          {"sweep", "a mapping of the task's parameters to lists or ranges", "{}",
           "One condition for every combination of values."},
          {"methods", "a list of 1…100 methods", "", "What is compared, on the same worlds."},
          {"metrics", "a list of metrics that the task reports", "(the task's)",
           "The headline metrics, most important first."},
          {"expect", "a list of expectations", "[]", "What should come out, judged after the run."},
          {"video", "a mapping", "(no motion is kept)", "Which motions are kept for the report's films."},
          {"limits", "a mapping", "{}", "What a cell, or the building of a world, may take before it is ended."},
          {"gate", "a mapping", "{}", "What `etude gate` holds against a baseline."}};
}

KeyGroup SweepKeys() {
  return {"sweep",
          "A sweep, beside the task's parameters",
          {{"together", "a mapping of parameters to as many values each, or a list of such", "(none are)",
            "Parameters stepped through side by side, instead of in all combinations."}}};
}

KeyGroup RangeKeys() {
  return {"sweep.PARAMETER",
          "A range of values",
          {{"from", "a number", "", "The first value."},
           {"to", "a number", "", "The last value; with `step`, it is not passed."},
           {"step", "a number but 0", "(`count` says it)", "From one value to the next."},
           {"count", "2…1000", "(`step` says it)", "How many values, spread from `from` to `to`."},
           {"scale", "linear, log", "linear", "Equal differences, or equal ratios; log goes with `count`."}}};
}

KeyGroup MethodKeys() {
  return {"methods[]",
          "A method",
          {{"name", "at most 80 letters, digits, '-', '_', '.'", "", "Its name, unique in the scenario."},
           {"against", "a method", "(the first method)", "The method it is compared with."},
           {"exec", "a list: a program and its arguments", "(the method is built in)",
            "Another program that answers; such a method has none of its task's keys."},
           {"options", "a mapping; with `exec`", "{}", "Told to that program as JSON."},
           {"time_s", "0.001…86400; with `exec`", "(`limits.time_s`)", "How long it may take over one problem."}}};
}

KeyGroup ExpectationKeys() {
  return {
      "expect[]",
      "An expectation",
      {{"metric", "a metric that the task reports", "", "What is judged."},
       {"of", "a method", "", "Whose values are judged."},
       {"below", "a method", "(another claim is made)", "`of` has lower values in the same worlds."},
       {"above", "a method", "(another claim is made)", "`of` has higher values in the same worlds."},
       {"at_most", "a number", "(another claim is made)", "The statistic is not above it."},
       {"at_least", "a number", "(another claim is made)", "The statistic is not below it."},
       {"statistic", "median, mean, p95", "median", "What `at_most` and `at_least` are about."},
       {"confidence", "0.5…0.999", "0.95", "How sure `below` and `above` must be."},
       {"where", "a mapping of swept parameters to one of their values", "{}", "Judged in these conditions only."}}};
}

KeyGroup VideoKeys() {
  return {"video",
          "What is kept for films",
          {{"compare", "a list of methods", "(all)", "Whose motions are kept."},
           {"trials", "a list of whole numbers below `trials`", "[0]", "Of which worlds."}}};
}

KeyGroup LimitKeys() {
  const Limits limits;
  return {"limits",
          "Limits",
          {{"time_s", "0.001…86400", fmt::format("{:g}", limits.time_s), "Seconds by the clock."},
           {"memory_mb", "16…1048576", fmt::format("{:g}", limits.memory_mb),
            "Resident memory of the worker, and of each program it has started."}}};
}

KeyGroup GateKeys() {
  return {"gate",
          "The gate",
          {{"metrics", "a list of metrics that the task reports", "(`metrics`)", "What is compared."},
           {"rule", "threshold, exact", "threshold",
            "Only a difference that matters is a regression, or every difference is."},
           {"time_ratios", "a list of ratios", "[]", "How processor times may compare within the run."}}};
}

KeyGroup TimeRatioKeys() {
  return {"gate.time_ratios[]",
          "A ratio of times",
          {{"of", "a method", "", "Whose time is judged."},
           {"over", "a method", "", "By whose time it is divided, world by world."},
           {"at_most", "0.001…1000000", "1", "What the median of these ratios may be."}}};
}

std::string Cell(const std::string& text) {
  std::string cell;
  for (char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

std::span<const KeyInfo> CommonScenarioKeys() {
  static const std::vector<KeyInfo> keys = ScenarioKeys();
  return keys;
}

std::vector<KeyGroup> AllKeyGroups() {
  const KeyGroup scenarios = {"scenarios[]", "A scenario of any task", ScenarioKeys()};
  std::vector<KeyGroup> groups = {FileKeys(),        scenarios,   SweepKeys(), RangeKeys(), MethodKeys(),
                                  ExpectationKeys(), VideoKeys(), LimitKeys(), GateKeys(),  TimeRatioKeys()};
  for (const TaskKind& kind : AllTaskKinds()) {
    groups.push_back({"scenarios[]", "A scenario of task " + kind.name, kind.condition_keys});
    groups.push_back({"methods[]", "A method of task " + kind.name, kind.method_keys});
  }
  return groups;
}

std::string KeysAsMarkdown() {
  std::string page =
      "# Every key of a scenario file\n\n"
      "Written by `etude list keys --markdown`; a test compares the two. How they go together: "
      "[scenarios.md](scenarios.md).\nWords in (parentheses) say what happens when nothing is written; every other "
      "default could be written as it stands.\n";
  for (const KeyGroup& group : AllKeyGroups()) {
    page += fmt::format("\n## {}{}\n\n| key | allowed | default | meaning |\n|---|---|---|---|\n", group.title,
                        group.path.empty() ? "" : fmt::format(": `{}`", group.path));
    for (const KeyInfo& key : group.keys) {
      page += fmt::format("| `{}` | {} | {} | {} |\n", key.key, Cell(key.AllowedWhere()),
                          key.fallback.empty() ? "required" : Cell(key.fallback), Cell(key.meaning));
    }
  }
  return page;
}

}  // namespace etude
