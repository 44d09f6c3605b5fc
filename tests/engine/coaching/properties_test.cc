// Properties that must hold for every player: random players, every policy, several choices of transitions.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/random/stream.h"
#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

void DoAnything(RandomStream& dice, SmallSession::Player& player) {
  if (dice.Chance(0.01)) player.seen = dice.Chance(0.8);
  if (dice.Chance(0.01)) player.moves = dice.Chance(0.7);
  if (dice.Chance(0.02)) player.claps = dice.Chance(0.3);
  if (dice.Chance(0.02)) player.evidence = dice.Uniform();
  if (dice.Chance(0.02)) player.other_side = dice.Uniform();
  if (dice.Chance(0.02)) player.told_right = dice.Chance(0.5);
  player.moment = dice.Chance(0.003);
}

constexpr int kFrames = 4000;

class RandomPlayers : public ::testing::TestWithParam<int> {
 protected:
  RandomPlayers()
      : dice_({.suite_seed = 7, .scenario = "coach-properties", .trial = GetParam()}, "player"),
        session_({.idle_s = 8, .doze_s = 6}, AllPolicies()[GetParam() % AllPolicies().size()].name.c_str(), {},
                 GetParam() % 2 == 0 ? "now" : "fuzzy-bridge", GetParam() % 3 == 0 ? "cut" : "crossfade") {
    if (GetParam() % 4 == 0) session_.state() = session_.coach().Begin();
  }

  const CoachOutput& Next() {
    DoAnything(dice_, session_.player);
    // Now and then the music jumps by up to 0.3 s.
    if (session_.music_s && dice_.Chance(0.02)) *session_.music_s += dice_.Uniform(-0.3, 0.3);
    return session_.Next();
  }

  RandomStream dice_;
  SmallSession session_;
};

TEST_P(RandomPlayers, AreNotJudgedWhileTheCoachShowsAnythingElse) {
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    if (out.mode != CoachMode::kDance) {
      EXPECT_FALSE(session_.state().open) << i;
      for (const CoachRecord& record : out.records) {
        EXPECT_NE(record.event, CoachEvent::kRight);
        EXPECT_NE(record.event, CoachEvent::kWrong);
        EXPECT_NE(record.event, CoachEvent::kUnjudged);
      }
    }
  }
}

TEST_P(RandomPlayers, AreAskedForNothingThatTheCoachHasNotDancedFromItsBeginning) {
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    if (!out.asks || !out.open) continue;
    const Repetition& asked = session_.coach().dance().repetitions[static_cast<std::size_t>(out.open->repetition)];
    EXPECT_LE(out.clip_frame, static_cast<double>(asked.first) + 9 + 3) << i;  // 9 frames to react, 3 to catch up
  }
}

TEST_P(RandomPlayers, EveryWindowComesToOneVerdictBeforeTheNextOneOpens) {
  std::optional<OpenWindow> open;
  int verdicts = 0;
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    verdicts += static_cast<int>(std::ranges::count_if(out.records, [](const CoachRecord& record) {
      return record.event == CoachEvent::kRight || record.event == CoachEvent::kWrong ||
             record.event == CoachEvent::kUnjudged;
    }));
    if (!out.asks) continue;
    EXPECT_NE(out.open, open);
    if (open) {
      EXPECT_EQ(verdicts, 1) << i;
    }
    open = out.open;
    verdicts = 0;
  }
}

TEST_P(RandomPlayers, EveryDueTagIsHandledOnce) {
  int expected = -1;  // the next tag, once music plays
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    if (out.music.kind == MusicCommand::Kind::kPlayFrom) expected = session_.state().next_tag;
    for (const CoachRecord& record : out.records) {
      if (record.event == CoachEvent::kTag) {
        EXPECT_EQ(record.tag, expected++);
      }
    }
    if (out.mode != CoachMode::kDance || out.clip_frame < 0 || expected < 0) continue;
    const auto& tags = session_.coach().dance().tags;
    const bool is_due = expected < static_cast<int>(tags.size()) &&
                        out.clip_frame >= static_cast<double>(tags[expected].frame) && session_.music_s;
    // If a tag is due in the frame in which the music starts, it is handled in the next frame.
    if (is_due) {
      EXPECT_EQ(out.music.kind, MusicCommand::Kind::kPlayFrom) << i;
    }
  }
}

TEST_P(RandomPlayers, NeverBringItToAStandstill) {
  std::int64_t since = 0;
  CoachMode mode = session_.state().mode;
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    if (out.mode != mode || out.mode == CoachMode::kStandby || out.mode == CoachMode::kDoze) since = i;
    mode = out.mode;
    // The longest stay: a whole small dance, or attracting.
    EXPECT_LT(i - since, 700) << ModeName(mode);
    for (const glm::dvec3& joint : out.body.joints) ASSERT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
  }
}

TEST_P(RandomPlayers, GetTheSameOfACopyAndChangeNothingInTheState) {
  for (int i = 0; i < 600; ++i) Next();
  const CoachState copy = session_.state();
  SensedFrame frame = session_.Sensed();
  FeatureFrame features{.body_seen = true};
  const CoachInput input{.seen = {frame, features}, .evidence = {.asked = 0.7, .spotted = {}}, .music_s = 3.0};
  const CoachStep once = session_.coach().Step(copy, input), again = session_.coach().Step(copy, input);
  EXPECT_EQ(once.output.body.joints, again.output.body.joints);
  EXPECT_EQ(once.output.records.size(), again.output.records.size());
  EXPECT_EQ(once.state.frame, copy.frame + 1);
  EXPECT_EQ(again.state.frame, copy.frame + 1);
  EXPECT_EQ(once.state.playback.path_frame, again.state.playback.path_frame);
  EXPECT_EQ(once.state.playback.dance_frame, again.state.playback.dance_frame);
  EXPECT_EQ(copy.frame, session_.state().frame);
}

TEST_P(RandomPlayers, SeeABodyOfConstantLimbs) {
  const BodyPose rest = ArmsAt(0);
  for (int i = 0; i < kFrames; ++i) {
    const CoachOutput& out = Next();
    for (const Bone& bone : AllBones()) {
      ASSERT_NEAR(BoneLength(out.body, bone), BoneLength(rest, bone), 1e-6) << i << " " << RoleName(bone.child);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnyPolicy, RandomPlayers, ::testing::Range(0, 21));

TEST(Transitions, DoNotDependOnWhatWasAskedBefore) {
  SmallSession once, again;
  again.coach().PlanAhead();
  for (int i = 0; i < 1500; ++i) {
    ASSERT_EQ(once.Next().body.joints, again.Next().body.joints) << i;
  }
}

TEST(Transitions, AreContinuousWhereTheJoinIs) {
  SmallSession session({}, "at-first-mistake", {}, "now", "crossfade");
  BodyPose before = session.Next().body, now = session.Next().body;
  for (int i = 0; i < 3000; ++i) {
    const BodyPose next = session.Next().body;
    for (Role role : AllRoles()) {
      ASSERT_LT(glm::distance(next[role], now[role]), 0.12) << i << " " << RoleName(role) << " " << session.out().clip;
    }
    before = now;
    now = next;
  }
}

TEST(Transitions, ComeHomeWithTheDance) {
  SmallSession session;  // always wrong: three corrections, each with its own turn and shift
  ASSERT_TRUE(session.Until(CoachEvent::kGoesOn));
  const auto frame = static_cast<std::size_t>(session.out().clip_frame);
  const BodyPose& authored = session.coach().dance().motion.poses[frame];
  EXPECT_LT(glm::distance(session.out().body[Role::kHipCentre], authored[Role::kHipCentre]), 0.02);
}

}  // namespace
}  // namespace etude
