#include "engine/coaching/policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

bool Corrects(const char* policy, const PolicyInput& input, std::vector<double> settings = {}) {
  return FindPolicy(policy)->decide(input, settings).corrects;
}

PolicyInput Mistakes(int in_row, double evidence = 0.3, int corrections = 0) {
  return {.verdict = WindowVerdict::kWrong,
          .evidence = evidence,
          .right_from = 0.5,
          .move = {.judged = in_row, .mistakes = in_row, .mistakes_in_row = in_row, .corrections = corrections}};
}

TEST(Policy, KnowsItsNames) {
  EXPECT_THAT(PolicyNames(), ::testing::ElementsAre("at-first-mistake", "never", "after-n", "confidence", "fading",
                                                    "oracle", "yoked"));
  EXPECT_EQ(FindPolicy("always"), nullptr);
}

TEST(Policy, CoachesRealPeopleWithoutTheTruthOrAnotherSession) {
  EXPECT_THAT(LivePolicyNames(),
              ::testing::ElementsAre("at-first-mistake", "never", "after-n", "confidence", "fading"));
}

TEST(Policy, CorrectsNothingThatIsNoMistake) {
  for (const Policy& policy : AllPolicies()) {
    for (WindowVerdict verdict : {WindowVerdict::kRight, WindowVerdict::kUnknown}) {
      PolicyInput input = Mistakes(9);
      input.verdict = verdict;
      EXPECT_FALSE(policy.decide(input, {}).corrects) << policy.name;
    }
  }
}

TEST(Policy, DecidesAsItSays) {
  EXPECT_TRUE(Corrects("at-first-mistake", Mistakes(1)));
  EXPECT_FALSE(Corrects("never", Mistakes(9)));
  EXPECT_FALSE(Corrects("after-n", Mistakes(1)));
  EXPECT_TRUE(Corrects("after-n", Mistakes(2)));
  EXPECT_FALSE(Corrects("after-n", Mistakes(2), {3}));
  EXPECT_TRUE(Corrects("after-n", Mistakes(3), {3}));
  EXPECT_FALSE(Corrects("confidence", Mistakes(1, 0.3)));
  EXPECT_TRUE(Corrects("confidence", Mistakes(1, 0.2)));
  EXPECT_TRUE(Corrects("confidence", Mistakes(1, 0.4), {0.9}));
  EXPECT_TRUE(Corrects("fading", Mistakes(1, 0.3, 0)));
  EXPECT_FALSE(Corrects("fading", Mistakes(2, 0.3, 2)));
  EXPECT_TRUE(Corrects("fading", Mistakes(3, 0.3, 2)));
  EXPECT_TRUE(Corrects("oracle", Mistakes(1)));
  EXPECT_FALSE(Corrects("yoked", Mistakes(9)));
}

TEST(Policy, EveryDecisionSaysWhy) {
  for (const Policy& policy : AllPolicies()) EXPECT_FALSE(policy.decide(Mistakes(1), {}).why.empty()) << policy.name;
}

TEST(Policy, TheOracleJudgesByWhatItIsToldAlone) {
  SmallSession right({}, "oracle");
  right.player.told_right = true;  // the recogniser sees nothing, and the player stands still
  right.player.moves = false;
  ASSERT_TRUE(right.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(right.Count(CoachEvent::kRight), 4);

  SmallSession wrong({}, "oracle");
  wrong.player.told_right = false;
  wrong.player.evidence = 1;
  ASSERT_TRUE(wrong.Until(CoachEvent::kCorrects));

  SmallSession untold({}, "oracle");
  untold.player.evidence = 1;
  ASSERT_TRUE(untold.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(untold.Count(CoachEvent::kUnjudged), 4);
}

TEST(Policy, TheYokedCoachCorrectsAtAGivenMomentOrAsSoonAsItDancesAgain) {
  SmallSession session({}, "yoked");
  session.player.evidence = 1;
  for (int i = 0; i < 80; ++i) session.Next();
  session.player.moment = true;
  session.Next();
  EXPECT_EQ(session.Count(CoachEvent::kCorrects), 1);
  for (int i = 0; i < 20; ++i) session.Next();
  session.player.moment = true;  // during the correction
  ASSERT_TRUE(session.Until(CoachEvent::kReturns));
  ASSERT_TRUE(session.Until(CoachEvent::kCorrects));
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Count(CoachEvent::kCorrects), 2);
}

TEST(Policy, NobodyElseListensToMoments) {
  SmallSession session;
  session.player.evidence = 1;
  session.player.moment = true;
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Count(CoachEvent::kCorrects), 0);
}

}  // namespace
}  // namespace etude
