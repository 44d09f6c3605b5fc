// Claps, stillness, mirror images, and the checks of a dance.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/coaching/coach.h"
#include "engine/coaching/session.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"
#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

int Claps(const BodyMotion& motion) {
  ClapState state;
  int claps = 0;
  for (const SensedFrame& frame : StreamOf(motion).frames) claps += SeeClap(frame, state) ? 1 : 0;
  return claps;
}

TEST(SeeClap, SeesTheClapsOfAMoveAndOfNoOther) {
  const auto clap = LoadBuiltinMove("clap");
  EXPECT_GE(Claps(clap->motion), 1);
  for (const char* other : {"stretch", "sway", "boxing", "side_kick", "standby"}) {
    EXPECT_EQ(Claps(LoadBuiltinMove(other)->motion), 0) << other;
  }
}

TEST(SeeClap, DoesNotTakeHandsThatAreGuessedForAClap) {
  ClapState state;
  for (SensedFrame frame : StreamOf(LoadBuiltinMove("clap")->motion).frames) {
    frame[Role::kLeftHand].state = TrackingState::kInferred;
    EXPECT_FALSE(SeeClap(frame, state));
  }
}

double MovingShare(const BodyMotion& motion, double noise_m) {
  RandomStream dice({.suite_seed = 5, .scenario = "stillness", .trial = 0}, "noise");
  StillnessState state;
  for (SensedFrame frame : StreamOf(motion).frames) {
    for (SensedJoint& joint : frame.joints) joint.position += noise_m * dice.Normal3();
    SeeMotion(frame, state);
  }
  return static_cast<double>(state.moving) / state.seen;
}

TEST(SeeMotion, TellsEveryMoveFromStandingWithASensorsNoise) {
  for (const std::string& move : BuiltinMoveNames()) {
    EXPECT_GT(MovingShare(LoadBuiltinMove(move)->motion, 0.004), 0.3) << move;
  }
  EXPECT_EQ(MovingShare({.poses = std::vector<BodyPose>(300, ArmsAt(10))}, 0.004), 0);
}

TEST(SeeMotion, IsNotTakenInByALimbThatIsGuessed) {
  StillnessState state;
  SensedFrame frame = StreamOf({.poses = {ArmsAt(10)}}).frames.front();
  for (int i = 0; i < 100; ++i) {
    frame[Role::kLeftHand].position.y = i % 2;
    frame[Role::kLeftHand].state = TrackingState::kInferred;
    EXPECT_FALSE(SeeMotion(frame, state));
  }
}

TEST(MirrorImage, TwiceIsTheFrameItself) {
  const SensedFrame frame = StreamOf(LoadBuiltinMove("boxing")->motion).frames[20];
  const SensedFrame image = MirrorImage(frame), back = MirrorImage(image);
  EXPECT_EQ(image[Role::kLeftHand].position.x, -frame[Role::kRightHand].position.x);
  for (std::size_t i = 0; i < kRoleCount; ++i) EXPECT_EQ(back.joints[i].position, frame.joints[i].position);
}

TEST(CheckDance, SaysWhatIsWrong) {
  const auto complaint = [](const auto& spoil) {
    Dance dance = SmallDance();
    spoil(dance);
    const auto made = DanceLibrary::Make(std::move(dance));
    return made ? std::string("nothing") : ToString(made.error());
  };
  EXPECT_EQ(complaint([](Dance&) {}), "nothing");
  EXPECT_THAT(complaint([](Dance& dance) { dance.acts.pop_back(); }), HasSubstr("lacks the act 'praise'"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.repetitions[1].first = 40; }), HasSubstr("repetition 1"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.repetitions[1].move = 2; }), HasSubstr("move 2 of 2"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.repetitions[3].end = 9999; }), HasSubstr("9999"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.repetitions.clear(); }), HasSubstr("no repetition"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.tags[2].music_s = 0; }), HasSubstr("must ascend"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.tags[3].frame = 99999; }), HasSubstr("99999"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.moves[1].name = "first"; }), HasSubstr("two moves 'first'"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.moves[0].slow.poses.resize(1); }), HasSubstr("slow demonstration"));
  EXPECT_THAT(complaint([](Dance& dance) { dance.motion.rate_hz = 60; }), HasSubstr("60 Hz"));
}

}  // namespace
}  // namespace etude
