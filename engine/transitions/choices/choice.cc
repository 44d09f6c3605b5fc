#include "engine/transitions/choices/choice.h"

#include <array>

#include "engine/transitions/choices/abrupt.h"
#include "engine/transitions/choices/fuzzy_bridge.h"
#include "engine/transitions/choices/matching.h"
#include "engine/transitions/choices/through_standing.h"
#include "engine/transitions/choices/unbroken.h"

namespace etude {
namespace {

// A function, so that the table is made after every string it is made of.
std::span<const Choice> Table() {
  static const RuleSetting kLeastPlay{
      "least_play_s", &SwitchRules::least_play_s, 0, 60,
      "Seconds of the wanted clip that must be left to play; its front half may always be entered."};
  static const RuleSetting kCloud{"window_s", &SwitchRules::window_s, 0, 2,
                                  "Seconds of motion that the point clouds hold, half of them after the frame."};
  static const RuleSetting kSurroundings{"reach_s", &SwitchRules::reach_s, 0, 2,
                                         "Seconds before and after the frame over which distances are averaged."};
  static const std::array kChoices = {
      Choice{.name = "fuzzy-bridge",
             .description = "paper A's: the first bridge frames that match, else through an in-between",
             .matches_poses = true,
             .uses_fuzzy = true,
             .plan = PlanFuzzyBridge},
      Choice{.name = "fuzzy-kovar",
             .description = "of all frames that match, those with the least point-cloud distance (Kovar 2002)",
             .matches_poses = true,
             .uses_fuzzy = true,
             .any_frame = true,
             .settings = {kCloud, kLeastPlay},
             .plan = PlanFuzzyKovar},
      Choice{.name = "fuzzy-window",
             .description = "of all frames that match, those with the least mean fuzzy distance around them",
             .matches_poses = true,
             .uses_fuzzy = true,
             .any_frame = true,
             .settings = {kSurroundings, kLeastPlay},
             .plan = PlanFuzzyWindow},
      Choice{.name = "point-cloud",
             .description = "the frames with the least point-cloud distance (Kovar 2002)",
             .matches_poses = true,
             .any_frame = true,
             .settings = {kCloud, kLeastPlay},
             .plan = PlanPointCloud},
      Choice{.name = "motion-matching",
             .description = "the frames where hands, feet and hips are and move most alike (Clavet 2016)",
             .matches_poses = true,
             .any_frame = true,
             .settings = {kLeastPlay},
             .plan = PlanMotionMatching},
      Choice{.name = "through-standing",
             .description = "at once, by a standing pose into the clip's first frame",
             .plan = PlanThroughStanding},
      Choice{.name = "now", .description = "at once, into the clip's first frame", .plan = PlanNow},
      Choice{.name = "wait-for-end",
             .description = "after the playing clip's last frame, into the clip's first",
             .plan = PlanWaitForEnd},
      Choice{.name = "unbroken",
             .description = "no switch: the playing clip goes on, as a yardstick",
             .plan = PlanUnbroken},
  };
  return kChoices;
}

}  // namespace

std::span<const Choice> AllChoices() { return Table(); }

std::vector<std::string> ChoiceNames() {
  std::vector<std::string> names;
  for (const Choice& choice : AllChoices()) names.push_back(choice.name);
  return names;
}

const Choice* FindChoice(std::string_view name) {
  for (const Choice& choice : AllChoices()) {
    if (choice.name == name) return &choice;
  }
  return nullptr;
}

}  // namespace etude
