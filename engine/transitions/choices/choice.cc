#include "engine/transitions/choices/choice.h"

#include <array>
#include <utility>

#include "engine/base/named.h"
#include "engine/transitions/choices/fuzzy_bridge.h"
#include "engine/transitions/choices/matching.h"
#include "engine/transitions/choices/plain_choices.h"
#include "engine/transitions/choices/played.h"

namespace etude {
namespace {

using Library = const MotionLibrary&;
using Request = const TransitionRequest&;
using Rules = const MatchRules&;
using Values = std::span<const double>;

/// A row's `plan`, of a choice without options of its own.
template <auto Plan>
TransitionRecord PlanBy(Library library, Request request, Rules rules, Values /*values*/) {
  return Plan(library, request, rules);
}

/// Plans by a choice that has options, which are made of the values.
template <auto Plan, auto Settings>
TransitionRecord PlanWith(Library library, Request request, Rules rules, Values values) {
  return Plan(library, request, rules, Settings().Apply(values));
}

template <auto Settings>
AllowedFrames AnyFramesWith(Library library, Request request, Values values) {
  return AllowedAnyFrames(library, request, Settings().Apply(values).least_play_s);
}

AllowedFrames BridgeFrames(Library library, Request request, Values /*values*/) {
  return AllowedBridgeFrames(library, request);
}

/// A choice that ranks every pair of frames.
template <auto Plan, auto Settings>
Choice Ranked(const char* name, const char* description, bool uses_fuzzy) {
  return {.name = name,
          .description = description,
          .matches_poses = true,
          .uses_fuzzy = uses_fuzzy,
          .settings = Settings().Describe(),
          .allowed = AnyFramesWith<Settings>,
          .plan = PlanWith<Plan, Settings>};
}

// A function, so that the table is made after every string it is made of.
std::span<const Choice> Table() {
  static const std::array kChoices = {
      Choice{.name = "fuzzy-bridge",
             .description = "paper A's: the first bridge frames that match, else through an in-between",
             .matches_poses = true,
             .uses_fuzzy = true,
             .allowed = BridgeFrames,
             .plan = PlanBy<PlanFuzzyBridge>},
      Ranked<PlanFuzzyKovar, PointCloudSettings>(
          "fuzzy-kovar", "of all frames that match, those with the least point-cloud distance (Kovar 2002)", true),
      Ranked<PlanFuzzyWindow, FuzzyWindowSettings>(
          "fuzzy-window", "of all frames that match, those with the least mean fuzzy distance around them", true),
      Ranked<PlanPointCloud, PointCloudSettings>("point-cloud",
                                                 "the frames with the least point-cloud distance (Kovar 2002)", false),
      Ranked<PlanMotionMatching, MotionMatchingSettings>(
          "motion-matching", "the frames where hands, feet and hips are and move most alike (Clavet 2016)", false),
      Choice{.name = "played",
             .description = "the frames and length whose transition, played, costs least time and acceleration",
             .settings = PlayedSettings().Describe(),
             .plan = PlanWith<PlanPlayed, PlayedSettings>},
      Choice{.name = "through-standing",
             .description = "at once, by a standing pose into the clip's first frame",
             .plan = PlanBy<PlanThroughStanding>},
      Choice{.name = "now", .description = "at once, into the clip's first frame", .plan = PlanBy<PlanNow>},
      Choice{.name = "wait-for-end",
             .description = "after the playing clip's last frame, into the clip's first",
             .plan = PlanBy<PlanWaitForEnd>},
      Choice{.name = "unbroken",
             .description = "no transition: the playing clip goes on, as a yardstick",
             .plan = PlanBy<PlanUnbroken>},
  };
  return kChoices;
}

}  // namespace

std::span<const Choice> AllChoices() { return Table(); }

std::vector<std::string> ChoiceNames() { return NamesOf(AllChoices()); }
const Choice* FindChoice(std::string_view name) { return FindByName(AllChoices(), name); }

Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way) {
  Transition made{way.choice->plan(library, request, way.rules, way.choice_settings), {}};
  if (!made.record.segments.empty()) {
    made.splice = SpliceSegments(library.motions, made.record.segments, *way.join, way.join_settings);
  }
  return made;
}

}  // namespace etude
