// The detection of claps, stillness and mirror images, and the checks of a dance.

#include <gtest/gtest.h>

#include "engine/coaching/coach.h"
#include "engine/coaching/session.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"
#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

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

TEST(SeeClap, IsOfHandsThatMeetAboveTheHipsSoonAfterTheyWereApart) {
  const auto claps = [](double apart_m, double together_m, double height, int on_the_way) {
    ClapState state;
    int seen = 0;
    for (int t = 0; t < on_the_way + 3; ++t) {
      SensedFrame frame = StreamOf({.poses = {ArmsAt(20)}}).frames.front();
      const double gap = t == 0 ? apart_m : t < on_the_way ? 0.3 : together_m;
      frame[Role::kHipCentre].position.y = 1;
      frame[Role::kLeftHand].position = {gap, height, 0};
      frame[Role::kRightHand].position = {0, height, 0};
      seen += SeeClap(frame, state);
    }
    return seen;
  };
  EXPECT_EQ(claps(0.41, 0.1, 1.1, 4), 1);
  EXPECT_EQ(claps(0.40, 0.1, 1.1, 4), 0) << "never apart";
  EXPECT_EQ(claps(0.41, 0.15, 1.1, 4), 0) << "never together";
  EXPECT_EQ(claps(0.41, 0.149, 1.1, 4), 1);
  EXPECT_EQ(claps(0.41, 0.1, 1.0, 4), 0) << "as high as the hips";
  EXPECT_EQ(claps(0.41, 0.1, 1.1, 14), 1);
  EXPECT_EQ(claps(0.41, 0.1, 1.1, 15), 0) << "too late";
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
    return made ? std::string("nothing") : made.error().message.substr(std::string("dance 'small'").size());
  };
  EXPECT_EQ(complaint([](Dance&) {}), "nothing");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].end = d.repetitions[1].first + 2; }), "nothing");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].end = d.repetitions[1].first + 1; }),
            ", repetition 1: found frames 120 to 121; allowed: at least two frames in the range 120 to 420");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[3].end = d.motion.poses.size(); }), "nothing");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[3].end = 421; }),
            ", repetition 3: found frames 300 to 421; allowed: at least two frames in the range 300 to 420");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].first = 119; }),
            ", repetition 1: found frames 119 to 210; allowed: at least two frames in the range 120 to 420");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[2].move = -1; }),
            ", repetition 2: there is no move -1; moves are counted from 0, and the dance has 2 moves");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].move = 2; }),
            ", repetition 1: there is no move 2; moves are counted from 0, and the dance has 2 moves");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions.clear(); }), " has no repetition");
  EXPECT_EQ(complaint([](Dance& d) { d.moves[1].name = "first"; }), ": two moves are named 'first'");
  EXPECT_EQ(complaint([](Dance& d) { d.moves[0].slow.poses.resize(2); }), "nothing");
  EXPECT_EQ(complaint([](Dance& d) { d.moves[0].slow.poses.resize(1); }),
            ": the slow demonstration of 'first' has 1 frames; allowed: at least 2");
  EXPECT_EQ(complaint([](Dance& d) { d.motion.rate_hz = 60; }), ": the song has a rate of 60 Hz; allowed: 30 Hz");
  EXPECT_EQ(complaint([](Dance& d) { d.acts.pop_back(); }), " lacks the act 'praise'");
  EXPECT_EQ(complaint([](Dance& d) { d.acts[3].motion.poses.clear(); }),
            ": the act 'wake' has 0 frames; allowed: at least 2");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[3].frame = 419; }), "nothing");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[3].frame = 420; }),
            ": a music-time tag has frame 420 and 10 s; allowed: a frame below 420 and a finite time");
  EXPECT_EQ(
      complaint([](Dance& d) { d.tags[1].frame = d.tags[0].frame; }),
      ": found the music-time tag (frame 30, 4 s) after the tag (frame 30, 1 s); allowed: increasing frames and times");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[1].music_s = d.tags[0].music_s; }),
            ": found the music-time tag (frame 120, 1 s) after the tag (frame 30, 1 s); allowed: increasing frames and "
            "times");
}

}  // namespace
}  // namespace etude
