#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "sim/choreography/slow_demonstration.h"
#include "sim/choreography/song.h"
#include "tests/sim/choreography/measures.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

Move Load(const std::string& name) {
  auto move = LoadBuiltinMove(name);
  EXPECT_TRUE(move) << ToString(move.error());
  return move ? std::move(*move) : Move{};
}

std::vector<Move> AllActs() {
  std::vector<Move> acts;
  for (const std::string& name : BuiltinActNames()) acts.push_back(Load(name));
  return acts;
}

double Lowest(const Move& move, Role role) {
  double lowest = 10;
  for (const BodyPose& pose : move.motion.poses) lowest = std::min(lowest, pose[role].y);
  return lowest;
}

double Highest(const Move& move, Role role) {
  double highest = -10;
  for (const BodyPose& pose : move.motion.poses) highest = std::max(highest, pose[role].y);
  return highest;
}

double Nearest(const Move& move, Role a, Role b) {
  double nearest = 10;
  for (const BodyPose& pose : move.motion.poses) nearest = std::min(nearest, glm::distance(pose[a], pose[b]));
  return nearest;
}

/// Counts how often `role` reverses its sideways motion by more than 2 cm, seen from the hips.
int SideToSide(const Move& move, Role role) {
  int turns = 0, direction = 0;
  double extreme = 0;
  for (std::size_t i = 0; i < move.motion.poses.size(); ++i) {
    const double x = move.motion.poses[i][role].x - move.motion.poses[i][Role::kHipCentre].x;
    if (i == 0 || direction * (x - extreme) > 0) {
      extreme = x;
      if (i == 0) direction = 1;
    } else if (direction * (extreme - x) > 0.02) {
      direction = -direction;
      extreme = x;
      ++turns;
    }
  }
  return turns;
}

TEST(BuiltinActs, AreTheCoachs) {
  EXPECT_THAT(BuiltinActNames(),
              ::testing::ElementsAre("attract", "doze", "head_shake", "praise", "puzzled", "standby", "wake", "wave"));
  for (const Move& act : AllActs()) {
    EXPECT_THAT(BuiltinActNames(), ::testing::Contains(act.name));
    EXPECT_TRUE(act.key_poses.empty()) << act.name;
  }
}

TEST(BuiltinClips, HaveNamesOfTheirOwnAcrossAllKinds) {
  std::multiset<std::string> names;
  for (const std::string& name : BuiltinMoveNames()) {
    names.insert(name);
    names.insert(std::string(kSlowDemonstrationPrefix) + name);
  }
  for (const std::string& name : BuiltinActNames()) names.insert(name);
  for (const std::string& name : BuiltinSongNames()) names.insert(name);
  ASSERT_GE(names.size(), 33u);
  for (const std::string& name : names) EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(BuiltinActs, WaitAndSleepForEverAndDoTheRestOnce) {
  for (const Move& act : AllActs()) {
    const bool waits = act.name == "standby" || act.name == "doze" || act.name == "attract";
    EXPECT_EQ(act.loops, waits) << act.name;
    const double gap = WorstJointDistance(act.motion.poses.front(), PoseOf(act.curves.At(act.beats)));
    if (waits) {
      EXPECT_LT(gap, 1e-9) << act.name;
    }
    EXPECT_NEAR(act.motion.DurationSeconds(), act.beats * 60 / act.tempo_bpm, 2.0 / kJudgedRateHz) << act.name;
  }
}

TEST(BuiltinActs, BeginAndEndNearTheReadyStanceUnlessAsleep) {
  const BodyPose ready = PoseOf(ReadyStance());
  constexpr double kNear = 0.10;
  for (const Move& act : AllActs()) {
    const bool begins_asleep = act.name == "doze" || act.name == "wake";
    EXPECT_EQ(WorstJointDistance(act.motion.poses.front(), ready) < kNear, !begins_asleep) << act.name;
    EXPECT_EQ(WorstJointDistance(act.motion.poses.back(), ready) < kNear, act.name != "doze") << act.name;
  }
  EXPECT_LT(WorstJointDistance(Load("wake").motion.poses.back(), ready), 1e-3);
}

TEST(BuiltinActs, WakeWhereTheyDoze) {
  EXPECT_LT(WorstJointDistance(Load("wake").motion.poses.front(), Load("doze").motion.poses.front()), 0.03);
}

TEST(BuiltinActs, StartAndStopAtRestWhenTheyDoNotLoop) {
  for (const Move& act : AllActs()) {
    if (act.loops) continue;
    const auto& poses = act.motion.poses;
    EXPECT_LT(WorstJointDistance(poses[0], poses[1]), 0.01) << act.name;
    EXPECT_LT(WorstJointDistance(poses[poses.size() - 2], poses.back()), 0.002) << act.name;
    EXPECT_EQ(act.curves.At(-1).values, act.curves.At(0).values) << act.name << ": stands before it begins";
    EXPECT_EQ(act.curves.At(act.beats + 5).values, act.curves.At(act.beats + 3).values) << act.name;
  }
}

TEST(BuiltinActs, NeverMoveFasterThanADancerNorSlideOnAStandingFoot) {
  constexpr double kFastest = 8.0;  // m/s
  std::vector<Move> shown = AllActs();
  for (const std::string& name : BuiltinMoveNames()) shown.push_back(Load("slow_" + name));
  for (const Move& act : shown) {
    const auto& poses = act.motion.poses;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      EXPECT_LT(WorstJointDistance(poses[i], poses[i - 1]) * kJudgedRateHz, kFastest) << act.name;
    }
    for (Role toe : {Role::kLeftFoot, Role::kRightFoot}) {
      const auto [fastest, down] = FastestSlide(act.motion, toe);
      EXPECT_LT(fastest, kStillMmps) << act.name;
      EXPECT_GT(down, static_cast<int>(poses.size() / 8)) << act.name;
    }
  }
}

// The features by which each act is recognised, measured on its joints.

TEST(BuiltinActs, DozeWithTheHeadOnTheChestAndWakeWithTheHandsAboveIt) {
  const BodyPose asleep = Load("doze").motion.poses.front();
  EXPECT_GT(asleep[Role::kHead].z, asleep[Role::kShoulderCentre].z + 0.1);
  EXPECT_LT(asleep[Role::kShoulderCentre].y, PoseOf(ReadyStance())[Role::kShoulderCentre].y - 0.07);
  const Move wake = Load("wake");
  EXPECT_GT(Highest(wake, Role::kLeftHand), Highest(wake, Role::kHead) + 0.2);
}

TEST(BuiltinActs, StandbyBreathesAndShiftsItsWeightWithBothFeetDown) {
  const Move standby = Load("standby");
  double left = -1, right = 1;
  for (const BodyPose& pose : standby.motion.poses) {
    left = std::max(left, pose[Role::kHipCentre].x);
    right = std::min(right, pose[Role::kHipCentre].x);
  }
  EXPECT_GT(left - right, 0.06);
  EXPECT_LT(Highest(standby, Role::kLeftFoot), CanonicalBody::kToeHeight + 0.001);
  EXPECT_LT(Highest(standby, Role::kLeftHand), 1.0) << "nothing that could be taken for a sign";
}

TEST(BuiltinActs, ShakeTheHeadFromSideToSideWithTheHandAlong) {
  const Move shake = Load("head_shake");
  EXPECT_GE(SideToSide(shake, Role::kHead), 4);
  EXPECT_GE(SideToSide(shake, Role::kRightHand), 4);
  EXPECT_LT(SideToSide(shake, Role::kHipCentre), 1);
}

TEST(BuiltinActs, WaveWithAHandBesideTheHead) {
  const Move wave = Load("wave");
  EXPECT_GT(Highest(wave, Role::kRightHand), Highest(wave, Role::kHead));
  EXPECT_GE(SideToSide(wave, Role::kRightHand), 6);
  for (const BodyPose& pose : wave.motion.poses) {
    if (pose[Role::kRightHand].y > pose[Role::kHead].y) {
      EXPECT_LT(pose[Role::kLeftHand].y, 1.0);
    }
  }
}

TEST(BuiltinActs, PuzzleWithAHandAtTheHeadAndATiltedHead) {
  const Move puzzled = Load("puzzled");
  EXPECT_LT(Nearest(puzzled, Role::kRightHand, Role::kHead), 0.2);
  EXPECT_GE(SideToSide(puzzled, Role::kHead), 2);
}

TEST(BuiltinActs, PraiseWithAClapAndAJump) {
  const Move praise = Load("praise");
  EXPECT_LT(Nearest(praise, Role::kLeftHand, Role::kRightHand), 0.08);
  EXPECT_GT(Highest(praise, Role::kLeftFoot), 0.15);
  EXPECT_GT(Highest(praise, Role::kRightHand), 1.9);
}

TEST(BuiltinActs, AttractWithEitherArmAndAHop) {
  const Move attract = Load("attract");
  EXPECT_GT(Highest(attract, Role::kLeftHand), 1.9);
  EXPECT_GT(Highest(attract, Role::kRightHand), 1.9);
  EXPECT_GT(Lowest(attract, Role::kHipCentre), 0.6);
  EXPECT_GT(Highest(attract, Role::kLeftFoot), 0.1);
}

constexpr std::string_view kSmallAct = R"(act: nod
beats: 4
loops: false
poses:
  - {beat: 0, neck: {bend: 10}}
  - {beat: 2, neck: {bend: 40}}
)";

TEST(ParseMove, ReadsAnActThatStaysInItsLastPose) {
  ASSERT_OK(act, ParseMove(kSmallAct, "nod.yaml"));
  EXPECT_EQ(act->name, "nod");
  EXPECT_EQ(act->motion.poses.size(), 61u) << "4 beats at the default 120 per minute, both ends";
  const auto bend = [&](double beat) { return Degrees(act->curves.At(beat)[MiddleControl::kNeckBend]); };
  for (double beat : {-3.0, 0.0}) EXPECT_NEAR(bend(beat), 10, 1e-9) << beat;
  for (double beat : {2.2, 4.0, 40.0}) EXPECT_NEAR(bend(beat), 40, 1e-9) << beat;
  // At rest at both ends, half-way in the middle (the neck follows 0.1 beats later).
  EXPECT_NEAR(bend(0.11), 10, 0.01);
  EXPECT_NEAR(bend(1.1), 25, 1e-9);
}

TEST(ParseMove, TellsAnActFromAMove) {
  std::string with_targets(kSmallAct);
  with_targets += "key_poses:\n  - {beat: 1, LH: 90}\n";
  EXPECT_THAT(testing::Refusal(ParseMove(with_targets, "nod.yaml")), HasSubstr("key_poses"));
  std::string move(kSmallAct);
  move.replace(0, 3, "move");
  EXPECT_THAT(testing::Refusal(ParseMove(move, "nod.yaml")), HasSubstr("loops"));
}

TEST(SlowDemonstration, HoldsEveryKeyPoseForABeatAtHalfTheTempo) {
  for (const std::string& name : BuiltinMoveNames()) {
    const Move move = Load(name), slow = Load("slow_" + name);
    EXPECT_EQ(slow.name, "slow_" + name);
    EXPECT_EQ(slow.tempo_bpm, 0.5 * move.tempo_bpm);
    EXPECT_GE(slow.beats, move.beats + static_cast<double>(move.key_poses.size())) << name;
    ASSERT_EQ(slow.key_poses.size(), move.key_poses.size());
    for (std::size_t i = 0; i < move.key_poses.size(); ++i) {
      const BodyPose shown = PoseOf(move.curves.At(move.key_poses[i].beat));
      // Curves are sampled at sixteenths of a beat, and a hold begins and ends between samples.
      for (double into : {0.07, 0.5, 0.93}) {
        const double apart = WorstJointDistance(shown, PoseOf(slow.curves.At(slow.key_poses[i].beat + into)));
        EXPECT_LT(apart, 1e-3) << name << " key pose " << i;
      }
    }
  }
}

TEST(SlowDemonstration, GoesTheSameWayAtHalfTheSpeed) {
  for (const std::string& name : BuiltinMoveNames()) {
    const Move move = Load(name), slow = Load("slow_" + name);
    const auto fastest = [](const BodyMotion& motion) {
      double distance = 0;
      for (std::size_t i = 1; i < motion.poses.size(); ++i) {
        distance = std::max(distance, WorstJointDistance(motion.poses[i], motion.poses[i - 1]));
      }
      return distance * kJudgedRateHz;
    };
    EXPECT_LT(fastest(slow.motion), 0.65 * fastest(move.motion)) << name;
    EXPECT_LT(WorstJointDistance(slow.motion.poses.front(), move.motion.poses.front()), 0.01) << name;
    // Nothing is held before the first key pose, so poses agree beat for beat.
    const double beat = 0.4 * move.key_poses.front().beat;
    EXPECT_LT(WorstJointDistance(PoseOf(slow.curves.At(beat)), PoseOf(move.curves.At(beat))), 0.01) << name;
  }
}

TEST(SlowDemonstration, FailsWhereThereIsNothingToShow) {
  EXPECT_THAT(ToString(SlowDemonstration(Load("wave")).error()), HasSubstr("'wave' has no key poses"));
  EXPECT_THAT(ToString(LoadBuiltinMove("slow_wave").error()), HasSubstr("unknown"));
  EXPECT_THAT(ToString(LoadBuiltinMove("slow_slow_clap").error()), HasSubstr("unknown"));
  Move early = Load("clap");
  early.key_poses.front().beat = 0;
  EXPECT_THAT(ToString(SlowDemonstration(early).error()), HasSubstr("beat 0"));
}

}  // namespace
}  // namespace etude
