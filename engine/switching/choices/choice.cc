#include "engine/switching/choices/choice.h"

#include <array>

#include "engine/switching/choices/abrupt.h"
#include "engine/switching/choices/fuzzy_bridge.h"

namespace etude {
namespace {

const std::array kChoices = {
    Choice{.name = "fuzzy-bridge",
           .description = "paper A's: the first bridge frames that match, else through an in-between",
           .matches_poses = true,
           .uses_fuzzy = true,
           .plan = PlanFuzzyBridge},
    Choice{.name = "now", .description = "at once, into the clip's first frame", .plan = PlanNow},
    Choice{.name = "wait-for-end",
           .description = "after the playing clip's last frame, into the clip's first",
           .plan = PlanWaitForEnd},
};

}  // namespace

std::span<const Choice> AllChoices() { return kChoices; }

std::vector<std::string> ChoiceNames() {
  std::vector<std::string> names;
  for (const Choice& choice : kChoices) names.push_back(choice.name);
  return names;
}

const Choice* FindChoice(std::string_view name) {
  for (const Choice& choice : kChoices) {
    if (choice.name == name) return &choice;
  }
  return nullptr;
}

}  // namespace etude
