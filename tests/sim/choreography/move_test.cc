#include "sim/choreography/move.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/fuzzy/features.h"
#include "sim/choreography/canonical_body.h"
#include "tests/sim/choreography/key_poses_shown.h"
#include "tests/sim/choreography/measures.h"
#include "tests/sim/performer/all_moves.h"
#include "tests/support/kept_answers.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const BodyPose& FrameAt(const Move& move, double beat) {
  const std::size_t frames = move.motion.poses.size();
  return move.motion
      .poses[static_cast<std::size_t>(std::lround(beat / move.beats * static_cast<double>(frames))) % frames];
}

TEST(BuiltinMoves, AreTheTenOfThePaperAndABird) {
  EXPECT_THAT(BuiltinMoveNames(), ::testing::ElementsAre("aerobic", "bird", "boxing", "clap", "fast_sway", "jump",
                                                         "robot", "side_kick", "side_stretch", "stretch", "sway"));
  for (const Move& move : AllMoves()) EXPECT_THAT(BuiltinMoveNames(), ::testing::Contains(move.name));
}

TEST(BuiltinMoves, LastAsLongAsTheirBeatsSay) {
  for (const Move& move : AllMoves()) {
    EXPECT_NEAR(move.motion.DurationSeconds(), move.beats * 60 / move.tempo_bpm, 0.5 / kJudgedRateHz) << move.name;
  }
}

TEST(BuiltinMoves, ShowEveryKeyPoseAtItsBeatWithRoomToSpare) {
  const double standing = StandingHipHeight(StandingPose());
  for (const Move& move : AllMoves()) {
    for (const KeyPose& key_pose : move.key_poses) {
      const PoseFeatures features = ComputeFeatures(FrameAt(move, key_pose.beat), standing);
      for (const KeyPose::Target& target : key_pose.targets) {
        EXPECT_NEAR(features[*FindFeature(target.feature)], target.degrees, 0.25 * target.tolerance_deg)
            << move.name << " " << target.feature << " at beat " << key_pose.beat;
      }
    }
  }
}

TEST(BuiltinMoves, AreNotReachedByStandingStill) {
  const BodyMotion still = {.poses = {PoseOf(ReadyStance()), StandingPose()}};
  for (const Move& move : AllMoves()) {
    EXPECT_FALSE(FirstReached(move.key_poses, still, 0, 1)) << move.name;
    for (const KeyPose& key_pose : move.key_poses) {
      EXPECT_FALSE(ShowsKeyPose(key_pose, StandingPose(), StandingHipHeight(StandingPose()))) << move.name;
    }
  }
}

TEST(BuiltinMoves, AreToldApartByTheirKeyPoses) {
  for (const Move& asked : AllMoves()) {
    for (const Move& danced : AllMoves()) {
      const bool reached = FirstReached(asked.key_poses, danced.motion, 0, danced.motion.DurationSeconds()).has_value();
      EXPECT_EQ(reached, asked.name == danced.name) << danced.name << " danced for " << asked.name;
    }
  }
}

TEST(BuiltinMoves, LoopWithoutASeam) {
  for (const Move& move : AllMoves()) {
    const auto& poses = move.motion.poses;
    double within = 0;
    for (std::size_t i = 1; i < poses.size(); ++i)
      within = std::max(within, WorstJointDistance(poses[i], poses[i - 1]));
    EXPECT_LE(WorstJointDistance(poses.front(), poses.back()), within) << move.name;
    EXPECT_LT(WorstJointDistance(PoseOf(move.curves.At(move.beats)), poses.front()), 1e-9) << move.name;
  }
}

TEST(BuiltinMoves, StartNearTheReadyStance) {
  for (const Move& move : AllMoves()) {
    const BodyPose ready = PoseOf(ReadyStance());
    for (Role role : {Role::kLeftFoot, Role::kRightFoot}) {
      EXPECT_LT(glm::distance(move.motion.poses.front()[role], ready[role]), 0.02) << move.name;
    }
    EXPECT_LT(glm::distance(move.motion.poses.front()[Role::kHipCentre], ready[Role::kHipCentre]), 0.12) << move.name;
  }
}

TEST(BuiltinMoves, HandsMeetInAClap) {
  ASSERT_OK(clap, LoadBuiltinMove("clap"));
  const auto gap = [](const BodyPose& pose) { return glm::distance(pose[Role::kLeftHand], pose[Role::kRightHand]); };
  EXPECT_LT(gap(FrameAt(*clap, 1.12)), 0.08);
  EXPECT_GT(gap(FrameAt(*clap, 0.5)), 0.8);
}

TEST(LoadBuiltinMove, NamesTheNearestKnownMove) {
  EXPECT_THAT(testing::Message(LoadBuiltinMove("side_kik")), HasSubstr("side_kick"));
}

constexpr std::string_view kSmallMove = R"(move: nod
beats: 2
poses:
  - beat: 0
  - {beat: 1, neck: {bend: 20}, left_arm: {forward: 90}, jump_cm: 3}
key_poses:
  - {beat: 1, LH: {degrees: 90, tolerance_deg: 5}}
)";

TEST(ParseMove, ReadsAnglesLengthsAndKeyPoses) {
  ASSERT_OK(move, ParseMove(kSmallMove, "nod.yaml"));
  EXPECT_EQ(move->motion.poses.size(), 30u) << "2 beats at the default 120 per minute";
  EXPECT_NEAR(move->curves.At(1)[MiddleControl::kJump], 0.03, 1e-12);
  ASSERT_EQ(move->key_poses.size(), 1u);
  EXPECT_EQ(move->key_poses[0].targets[0].tolerance_deg, 5);
  EXPECT_EQ(ReadyStance().Of(Side::kRight, SideControl::kElbow),
            move->curves.At(1).Of(Side::kRight, SideControl::kElbow));
}

TEST(ParseMove, TellsWhereAndWhatIsWrong) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/sim/choreography/move_complaints.txt", [](const std::string& edit) {
    return testing::Refusal(ParseMove(testing::Edited(std::string(kSmallMove), edit), "nod.yaml"));
  }));
}

TEST(ParseMove, SuitsItsOwnTempoUnlessARangeIsGiven) {
  ASSERT_OK(move, ParseMove(kSmallMove, "nod.yaml"));
  EXPECT_EQ(move->slowest_bpm, 120);
  EXPECT_EQ(move->fastest_bpm, 120);
  ASSERT_OK(wide, ParseMove(std::string(kSmallMove) + "tempo_range_bpm: [90, 150]\n", "nod.yaml"));
  EXPECT_EQ(wide->slowest_bpm, 90);
  EXPECT_EQ(wide->fastest_bpm, 150);
}

TEST(ParseMove, ReachesAPoseAsItsEaseSays) {
  const auto bend_before = [](const std::string& ease) {
    const auto move = ParseMove(testing::Replaced(kSmallMove, "neck:", "ease: " + ease + ", neck:"), "nod.yaml");
    EXPECT_TRUE(move) << ToString(move.error());
    return move->curves.At(0.5)[MiddleControl::kNeckBend];
  };
  EXPECT_EQ(bend_before("snap"), 0);
  EXPECT_LT(bend_before("rush"), bend_before("smooth"));
  EXPECT_LT(bend_before("smooth"), bend_before("linger"));
}

TEST(ParseMove, MirrorsTheFirstHalf) {
  const std::string yaml = testing::Replaced(kSmallMove, "beats: 2", "beats: 4\nsecond_half_mirrored: true");
  ASSERT_OK(move, ParseMove(yaml, "nod.yaml"));
  EXPECT_NEAR(move->curves.At(1.04).Of(Side::kLeft, SideControl::kArmForward),
              move->curves.At(3.04).Of(Side::kRight, SideControl::kArmForward), 1e-12);
}

TEST(FirstReached, WaitsForTheLastKeyPoseAndKeepsToItsWindow) {
  ASSERT_OK(kick, LoadBuiltinMove("side_kick"));
  const double end = kick->motion.DurationSeconds();
  ASSERT_OK(reached, FirstReached(kick->key_poses, kick->motion, 0, end));
  const auto last_only = FirstReached({&kick->key_poses[1], 1}, kick->motion, 0, end);
  EXPECT_EQ(reached, last_only) << "the drawn-up knee comes before the kick";
  EXPECT_FALSE(FirstReached(kick->key_poses, kick->motion, 0, *reached - 0.02));
  EXPECT_TRUE(FirstReached(kick->key_poses, kick->motion, 0, *reached));
  EXPECT_FALSE(FirstReached(kick->key_poses, BodyMotion{}, 0, 1));
}

}  // namespace
}  // namespace etude
