#include <gtest/gtest.h>

#include <cmath>

#include "engine/fuzzy/features.h"
#include "engine/motion/body.h"
#include "engine/transitions/choices/choice.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

MotionLibrary Waving() {
  const std::vector<BodyMotion> clips = {WavingClip(60), WavingClip(80, 3)};
  return MakeLibrary({"wave", "greet"}, clips, MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight));
}

TEST(StandingPose, StandsUprightOnTheFloorWithHangingArms) {
  const BodyProportions proportions = Waving().proportions;
  const BodyPose pose = StandingPose(proportions);
  const PoseFeatures features = ComputeFeatures(pose, proportions.standing_hip_height);
  EXPECT_NEAR(features[Feature::kRH], 0, 1e-6);
  EXPECT_NEAR(features[Feature::kLH], 0, 1e-6);
  EXPECT_NEAR(features[Feature::kPosture], 80, 1e-6);
  EXPECT_NEAR(features[Feature::kTrunk], 180, 1e-6);
  EXPECT_NEAR(features[Feature::kLFK], 180, 1e-6);
  EXPECT_NEAR(Heading(pose), 0, 1e-12);
  for (const Bone& bone : AllBones()) {
    EXPECT_NEAR(BoneLength(pose, bone), proportions.limb_lengths[Index(bone.child)], 1e-12) << RoleName(bone.child);
  }
}

TEST(StandingPose, PutsTheToesOnTheFloorStraightAhead) {
  BodyProportions proportions = Waving().proportions;
  for (const Role foot : {Role::kLeftFoot, Role::kRightFoot}) proportions.limb_lengths[Index(foot)] = 0.2;
  const BodyPose pose = StandingPose(proportions);
  for (const auto& [foot, ankle] :
       {std::pair{Role::kLeftFoot, Role::kLeftAnkle}, {Role::kRightFoot, Role::kRightAnkle}}) {
    const double height = pose[ankle].y;
    ASSERT_TRUE(height > 0.05 && height < 0.1) << height;
    EXPECT_NEAR(pose[foot].y, 0, 1e-12);
    EXPECT_NEAR(pose[foot].x, pose[ankle].x, 1e-12);
    EXPECT_NEAR(pose[foot].z - pose[ankle].z, std::sqrt(0.2 * 0.2 - height * height), 1e-12);
  }
}

TEST(ThroughStanding, LeavesAtOnceStandsOnTheWayAndEntersAtTheFirstFrame) {
  const MotionLibrary library = Waving();
  const TransitionRecord record =
      FindChoice("through-standing")->plan(library, {.from = 0, .request_frame = 20, .to = 1}, {}, {});
  ASSERT_EQ(record.segments.size(), 3u);
  const std::vector<BodyPose>& own = record.segments[1].own;
  EXPECT_EQ(record.segments[0].last, 20);
  EXPECT_EQ(record.segments[2].first, 0);
  EXPECT_NEAR(PoseGap(own.front(), library.motions[0].poses[20]), 0, 1e-9);
  EXPECT_NEAR(PoseGap(own.back(), library.motions[1].poses[0]), 0, 1e-9);
  double nearest = 1;
  for (const BodyPose& pose : own) nearest = std::min(nearest, PoseGap(pose, StandingPose(library.proportions)));
  EXPECT_NEAR(nearest, 0, 1e-9);
  EXPECT_NEAR(record.wait_s, (static_cast<double>(own.size()) - 1) / 30, 1e-12);
}

TEST(Unbroken, MeetsItselfAtTheRequest) {
  const MotionLibrary library = Waving();
  const TransitionRecord record =
      FindChoice("unbroken")->plan(library, {.from = 0, .request_frame = 20, .to = 1}, {}, {});
  ASSERT_EQ(record.segments.size(), 2u);
  EXPECT_EQ(record.segments[1].clip, 0);
  EXPECT_EQ(record.segments[0].last, record.segments[1].first);
  EXPECT_EQ(record.distances[0].value, 0);
  EXPECT_EQ(record.wait_s, 0);
  EXPECT_TRUE(
      FindChoice("unbroken")->plan(library, {.from = 0, .request_frame = 59, .to = 1}, {}, {}).segments.empty());
}

}  // namespace
}  // namespace etude
