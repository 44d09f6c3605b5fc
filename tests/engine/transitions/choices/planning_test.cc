#include "engine/transitions/choices/planning.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/random_clips.h"

namespace etude {
namespace {

TEST(FuzzyGate, AgreesWithMatchesOnEveryPairThatTheRulesCompare) {
  RandomStream dice({.suite_seed = 6, .scenario = "gate", .trial = 0}, "clips");
  const MotionLibrary library = RandomLibrary(dice, {40, 53});
  const TaggedClip& playing = library.tagged[0];
  TaggedClip next = library.tagged[1];
  for (int frame = 0; frame < next.FrameCount(); frame += 2) next.tags[frame][3] = next.tags[frame][3] == 0 ? 1 : 0;
  std::vector<int> every_third;
  for (int frame = 0; frame < next.FrameCount(); frame += 3) every_third.push_back(frame);
  MatchRules rules;
  rules.threshold = 1.5;
  int matching[2] = {}, missing[2] = {};
  for (const bool within_class : {false, true}) {
    rules.within_class = within_class;
    FuzzyGate gate(playing, next, every_third, rules);
    for (int from = 0; from < playing.FrameCount(); ++from) {
      std::vector<int> compared;
      for (const auto& [to, distance, matches] : gate.Compare(from)) {
        compared.push_back(to);
        matching[within_class] += matches;
        EXPECT_EQ(distance, ComputeDistance(playing.grades[from], next.grades[to], rules.weights).value);
        EXPECT_EQ(matches, Matches(playing, from, next, to, rules));
      }
      std::vector<int> expected;
      for (int to : every_third) {
        if (!within_class || playing.tags[from] == next.tags[to]) expected.push_back(to);
      }
      EXPECT_EQ(compared, expected);
      missing[within_class] += static_cast<int>(every_third.size() - compared.size());
    }
  }
  EXPECT_GT(matching[0], matching[1]);
  EXPECT_EQ(missing[0], 0);
  EXPECT_GT(missing[1], 0) << "frames of other classes are left out";
}

TEST(FuzzyGate, HasNothingToCompareWithoutFramesToEnter) {
  RandomStream dice({.suite_seed = 6, .scenario = "gate", .trial = 1}, "clips");
  const MotionLibrary library = RandomLibrary(dice, {10, 10});
  const MatchRules rules;
  FuzzyGate gate(library.tagged[0], library.tagged[1], {}, rules);
  EXPECT_TRUE(gate.Compare(3).empty());
}

TEST(AllowedEarlyFrames, AreTheFirstThirdAndNoMoreThanMayBeSkipped) {
  RandomStream dice({.suite_seed = 6, .scenario = "early", .trial = 0}, "clips");
  const MotionLibrary library = RandomLibrary(dice, {40, 60});
  const TransitionRequest request{.from = 0, .request_frame = 5, .to = 1, .budget_s = 0.5};
  EXPECT_EQ(AllowedEarlyFrames(library, request, 60).enter.back(), 20);
  EXPECT_EQ(AllowedEarlyFrames(library, request, 0.5).enter.back(), 15);
  const AllowedFrames first = AllowedEarlyFrames(library, request, 0);
  EXPECT_EQ(first.enter, std::vector{0});
  EXPECT_EQ(first.leave, AllowedAnyFrames(library, request, 1).leave);
}

}  // namespace
}  // namespace etude
