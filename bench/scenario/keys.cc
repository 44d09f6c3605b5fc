#include "bench/scenario/keys.h"

#include <fmt/core.h>

#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "bench/scenario/scenario.h"
#include "bench/scenario/sources.h"
#include "bench/scenario/sweep.h"
#include "bench/tasks/registry.h"

namespace etude {
namespace {

/// A sweep has its task's parameters and this.
std::vector<KeyInfo> SweepKeys() {
  return {{"together",
           {"a mapping of parameters to as many values each, or a list of such", "{}"},
           "(none are)",
           "Parameters stepped through side by side, instead of in all combinations."}};
}

template <typename Keys>
KeyGroup Group(std::string path, std::string title, const Keys& keys) {
  return {std::move(path), std::move(title), {keys.begin(), keys.end()}};
}

std::string Cell(const std::string& text) {
  std::string cell;
  for (char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

}  // namespace

std::vector<KeyGroup> AllKeyGroups() {
  const Scenario any;
  std::vector<KeyGroup> groups = {
      Group("", "A file of several scenarios", FileKeys()),
      Group("scenarios[]", "A scenario of any task", CommonScenarioKeys()),
      Group("sweep", "A sweep, beside the task's parameters", SweepKeys()),
      Group("sweep.PARAMETER", "A range of values", RangeFields(kMostConditions).Describe()),
      Group("methods[]", "A method", OutsideMethodFields().Describe()),
      Group("expect[]", "An expectation", ExpectationFields(any, {}).Describe()),
      Group("video", "What is kept for films", VideoFields(any).Describe()),
      Group("limits", "Limits", LimitFields().Describe()),
      Group("gate", "The gate", GateFields(any, {}).Describe()),
      Group("gate.tail", "The gate's tail rule", TailFields().Describe()),
      Group("gate.time_ratios[]", "A ratio of times", TimeRatioFields(any).Describe())};
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
                          key.IsRequired() ? "required" : Cell(key.fallback), Cell(key.meaning));
    }
  }
  return page;
}

}  // namespace etude
