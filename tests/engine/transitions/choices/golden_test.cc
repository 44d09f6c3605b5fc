// The golden value of the choices: the plans of every choice, under several rules, for requests of libraries of every
// kind. The other tests of this folder check that results are right.
#include <gtest/gtest.h>

#include <array>

#include "engine/transitions/choices/choice.h"
#include "tests/engine/transitions/prints.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

/// Returns requests between all clips at any frame, also the last one, with no or plenty of time to wait.
std::vector<TransitionRequest> RequestsOf(const MotionLibrary& library, int count) {
  testing::Dice dice(7);
  std::vector<TransitionRequest> requests;
  const std::size_t clips = library.motions.size();
  for (int i = 0; i < count; ++i) {
    TransitionRequest request{.from = static_cast<int>(dice.Below(clips)), .request_frame = 0, .to = 0};
    request.to = static_cast<int>((request.from + 1 + dice.Below(clips - 1)) % clips);
    const int frames = library.tagged[request.from].FrameCount();
    request.request_frame = i == 4 ? frames - 1 : static_cast<int>(dice.Below(frames));
    request.budget_s = std::array{1.0, 0.5, 0.31, 2.0, 1.0, 0.0}[i % 6];
    requests.push_back(request);
  }
  return requests;
}

/// Returns paper A's rules; rules with every setting changed; rules that compare within the class only; and rules that
/// hardly ever match.
std::array<MatchRules, 4> FourRules() {
  std::array<MatchRules, 4> rules;
  rules[1].weights = {0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5};
  rules[1].threshold = 0.125;
  rules[1].pick = Pick::kSmallest;
  rules[2].threshold = 1.5;
  rules[2].within_class = true;
  rules[3].threshold = 0.01;
  return rules;
}

std::vector<double> OtherSettings(const Choice& choice) {
  std::vector<double> values;
  for (const NumberSetting& setting : choice.settings) values.push_back(0.4 * setting.fallback);
  return values;
}

TEST(ChoicesGolden, OfPlansInLibrariesOfEveryKind) {
  RandomStream dice({.suite_seed = 6, .scenario = "golden", .trial = 0}, "clips");
  const std::vector<MotionLibrary> libraries = {RandomLibrary(dice, {37, 52, 23, 90, 2}), LibraryOfTies(),
                                                LibraryOfMoves(), LibraryOfLying()};
  testing::Fingerprint print;
  std::vector<std::string> told;
  for (const Choice& choice : AllChoices()) {
    const bool is_dear = choice.name == "played";
    for (const MotionLibrary& library : libraries) {
      for (const TransitionRequest& request : RequestsOf(library, is_dear ? 3 : 6)) {
        for (const MatchRules& rules : FourRules()) {
          if (is_dear && (rules.within_class || rules.threshold < 0.1)) continue;
          const bool is_other = rules.pick == Pick::kSmallest;
          const std::vector<double> values = is_other ? OtherSettings(choice) : std::vector<double>();
          const TransitionRecord record = choice.plan(library, request, rules, values);
          AddTo(print, record);
          told.push_back(fmt::format("{}: {} to {}, {} clips: {}", choice.name, request.from, request.to,
                                     record.segments.size(), record.why));
          if (choice.allowed == nullptr) continue;
          const AllowedFrames allowed = choice.allowed(library, request, values);
          print.Add(allowed.leave).Add(allowed.enter);
        }
      }
    }
  }
  EXPECT_TRUE(print.Is(434421, -81836.1139372));
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/transitions/choices/why.txt"));
}

}  // namespace
}  // namespace etude
