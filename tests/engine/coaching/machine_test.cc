// The coach's state machine, transition by transition.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

TEST(CoachMachine, AClapAtStandbyBeginsTheSong) {
  SmallSession session;
  session.state() = session.coach().Begin();
  for (int i = 0; i < 60; ++i) EXPECT_EQ(session.Next().mode, CoachMode::kStandby);
  EXPECT_EQ(session.out().say, "Clap, and we dance!");
  session.player.claps = true;
  ASSERT_TRUE(session.Until(CoachEvent::kSongBegins, 60));
  EXPECT_EQ(session.Count(CoachEvent::kWoken), 1);
  EXPECT_EQ(session.Next().mode, CoachMode::kDance);
}

TEST(CoachMachine, WhoDoesNotTakePartIsAttractedThenTheCoachDozesUntilAClapWakesIt) {
  SmallSession session({.idle_s = 5, .doze_s = 4});
  session.state() = session.coach().Begin();
  session.player.moves = false;
  ASSERT_TRUE(session.Until(CoachEvent::kAttracts, 160));
  EXPECT_EQ(session.record().frame, 150);
  ASSERT_TRUE(session.Until(CoachEvent::kDozes, 200));
  EXPECT_EQ(session.Next().mode, CoachMode::kDoze);
  EXPECT_FALSE(session.Until(CoachEvent::kWoken, 300));
  session.player.claps = true;
  ASSERT_TRUE(session.Until(CoachEvent::kWoken, 60));
  EXPECT_EQ(session.Next().mode, CoachMode::kWake);
  ASSERT_TRUE(session.Until(CoachEvent::kSongBegins, 200));
}

TEST(CoachMachine, ARightPerformanceIsJudgedAsSoonAsItIsSeenAndTheDanceGoesOn) {
  SmallSession session;
  session.player.evidence = 0.9;
  ASSERT_TRUE(session.Until(CoachEvent::kRight, 60));
  EXPECT_EQ(session.record().repetition, 0);
  EXPECT_EQ(session.record().frame, 30 + 9 + 1);  // the window's first frame; it opens 0.3 s late
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Count(CoachEvent::kRight), 4);
  EXPECT_EQ(session.Count(CoachEvent::kWrong), 0);
  EXPECT_EQ(session.Count(CoachEvent::kCorrects), 0);
}

TEST(CoachMachine, AMistakeLeadsToAHeadShakeASlowDemonstrationAndBackToThatMove) {
  SmallSession session;
  ASSERT_TRUE(session.Until(CoachEvent::kWrong));
  EXPECT_EQ(session.record().repetition, 0);
  EXPECT_EQ(session.record().mistake, Mistake::kNotReached);
  EXPECT_EQ(session.record().frame, 30 + 90 + 9);  // the last frame of the window
  EXPECT_EQ(session.Count(CoachEvent::kCorrects), 1);
  EXPECT_EQ(session.Next().mode, CoachMode::kCorrect);
  EXPECT_EQ(session.out().clip, "head_shake");
  EXPECT_EQ(session.out().say, "Let us look at that again");
  ASSERT_TRUE(session.Until(CoachEvent::kShows));
  EXPECT_EQ(session.Next().mode, CoachMode::kDemonstrate);
  EXPECT_EQ(session.out().clip, "slow_first");
  EXPECT_EQ(session.out().hint, "first");
  EXPECT_EQ(session.out().picture, &session.coach().dance().moves[0].key_pose);
  ASSERT_TRUE(session.Until(CoachEvent::kReturns));
  EXPECT_EQ(session.record().repetition, 0);
  session.player.evidence = 0.9;
  ASSERT_TRUE(session.Until(CoachEvent::kPraises));
  EXPECT_EQ(session.record().repetition, 0);
  EXPECT_EQ(session.Next().say, "Well done!");
}

TEST(CoachMachine, WavesAtTheSecondMistakeIsPuzzledAtTheThirdAndThenGoesOn) {
  SmallSession session;
  std::vector<std::string> acts;
  while (session.Count(CoachEvent::kGoesOn) == 0) {
    ASSERT_TRUE(session.Until(CoachEvent::kWrong));
    session.Next();
    if (session.out().mode == CoachMode::kCorrect) acts.emplace_back(session.out().clip);
  }
  EXPECT_THAT(acts, ::testing::ElementsAre("head_shake", "wave", "puzzled"));
  EXPECT_EQ(session.Next().mode, CoachMode::kDance);
  ASSERT_TRUE(session.Until(CoachEvent::kWrong));
  EXPECT_EQ(session.record().repetition, 1);
  session.Next();
  EXPECT_EQ(session.out().clip, "puzzled") << "never a blunt no after several mistakes in a row";
}

TEST(CoachMachine, StandingStillIsAMistakeWhateverTheRecogniserSays) {
  SmallSession session;
  session.player.moves = false;
  session.player.evidence = 1;
  ASSERT_TRUE(session.Until(CoachEvent::kWrong));
  EXPECT_EQ(session.record().mistake, Mistake::kStoodStill);
  EXPECT_EQ(session.Count(CoachEvent::kRight), 0);
}

TEST(CoachMachine, WhoIsNotSeenIsNotJudged) {
  SmallSession session({.idle_s = 1000});
  session.player.seen = false;
  session.player.evidence = 1;
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Count(CoachEvent::kUnjudged), 4);
  EXPECT_EQ(session.Count(CoachEvent::kRight) + session.Count(CoachEvent::kWrong), 0);
  EXPECT_EQ(session.out().stand, PlayerHint::kComeIntoView);
}

TEST(CoachMachine, TheMirrorImageOfTheMoveIsTheWrongSide) {
  SmallSession session;
  session.player.other_side = 0.8;
  ASSERT_TRUE(session.Until(CoachEvent::kWrong));
  EXPECT_EQ(session.record().mistake, Mistake::kWrongSide);
  EXPECT_EQ(session.Next().say, "The other side");
}

TEST(CoachMachine, PraisesAtTheEndWhoWasMostlyRight) {
  SmallSession session;
  session.player.evidence = 1;
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Next().mode, CoachMode::kPraise);
  EXPECT_EQ(session.out().clip, "praise");
  for (int i = 0; i < 300 && session.out().mode == CoachMode::kPraise; ++i) session.Next();
  EXPECT_EQ(session.out().mode, CoachMode::kStandby);
}

TEST(CoachMachine, DoesNotPraiseAtTheEndWhoWasNot) {
  SmallSession session({}, "never");
  ASSERT_TRUE(session.Until(CoachEvent::kSongEnds));
  EXPECT_EQ(session.Count(CoachEvent::kPraises), 0);
  EXPECT_EQ(session.Next().mode, CoachMode::kStandby);
}

TEST(CoachMachine, LeavesTheDanceWhenNobodyTakesPart) {
  SmallSession session({.idle_s = 5}, "never");
  session.player.moves = false;
  ASSERT_TRUE(session.Until(CoachEvent::kAttracts));
  EXPECT_EQ(session.out().music.kind, MusicCommand::Kind::kPause);
  EXPECT_EQ(session.Next().mode, CoachMode::kAttract);
}

TEST(CoachMachine, TellsWhereToStand) {
  SmallSession session;
  for (int i = 0; i < 30; ++i) session.Next();
  EXPECT_EQ(session.out().stand, PlayerHint::kNone);
  SmallSession far({.sensor = {0, 1, 5}});
  for (int i = 0; i < 30; ++i) far.Next();
  EXPECT_EQ(far.out().stand, PlayerHint::kComeNearer);
  SmallSession near({.sensor = {0, 1, 1}});
  for (int i = 0; i < 30; ++i) near.Next();
  EXPECT_EQ(near.out().stand, PlayerHint::kStepBack);
}

TEST(CoachMachine, MusicPausesInACorrectionAndGoesOnWhereTheDanceDoes) {
  SmallSession session;
  while (session.Next().music.kind == MusicCommand::Kind::kNone) {
  }
  EXPECT_EQ(session.out().music.music_s, 0);
  ASSERT_TRUE(session.Until(CoachEvent::kCorrects));
  EXPECT_EQ(session.out().music.kind, MusicCommand::Kind::kPause);
  ASSERT_TRUE(session.Until(CoachEvent::kReturns));
  while (session.Next().music.kind == MusicCommand::Kind::kNone) {
  }
  EXPECT_EQ(session.out().music.kind, MusicCommand::Kind::kPlayFrom);
  EXPECT_DOUBLE_EQ(session.out().music.music_s, session.out().clip_frame / kJudgedRateHz);
  EXPECT_LE(session.out().clip_frame, 30.0 + 30) << "not later than a second into the repetition";
}

}  // namespace
}  // namespace etude
