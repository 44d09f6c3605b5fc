#include "engine/transitions/library/body_proportions.h"

#include <gtest/gtest.h>

#include "engine/fuzzy/features.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

TEST(PerformedBy, GivesEveryClipTheCharactersLimbsAndHeight) {
  BodyMotion small = WavingClip(40);
  for (BodyPose& pose : small.poses) {
    for (glm::dvec3& joint : pose.joints) joint = 0.6 * joint + glm::dvec3(0, 0.3, 0);
  }
  const BodyProportions character = MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9);
  const BodyMotion performed = PerformedBy(character, {&small, 1}).front();
  const BodyMotion waving = WavingClip(40);
  const BodyMotion full_size = PerformedBy(character, {&waving, 1}).front();
  EXPECT_NEAR(StandingHipHeight(performed.poses[0]), 0.9, 1e-12);
  for (std::size_t f = 0; f < performed.poses.size(); ++f) {
    ExpectSamePose(performed.poses[f], full_size.poses[f], 1e-9);
  }
  EXPECT_NEAR(performed.poses[0][Role::kLeftFoot].y, 0, 1e-12) << "set down on the floor";
}

TEST(MedianProportions, AreThoseOfTheBodyWhateverItsFirstFrameShows) {
  BodyMotion waving = WavingClip(41);
  const BodyPose good = waving.poses.front();
  waving.poses.front()[Role::kLeftKnee].y += 0.06;
  waving.poses.front()[Role::kRightElbow].x += 0.06;
  const BodyProportions body = MedianProportions(waving.poses);
  const BodyProportions wanted = MakeBodyProportions(good, StandingHipHeight(good));
  EXPECT_NEAR(body.standing_hip_height, wanted.standing_hip_height, 1e-12);
  for (std::size_t i = 0; i < kRoleCount; ++i) EXPECT_NEAR(body.limb_lengths[i], wanted.limb_lengths[i], 1e-12) << i;
  const BodyProportions of_first = MakeBodyProportions(waving.poses[0], StandingHipHeight(waving.poses[0]));
  EXPECT_GT(std::abs(of_first.standing_hip_height - wanted.standing_hip_height), 0.001) << "the control";
}

TEST(PerformedBy, SetsClipsOfOnePersonDownTogetherAndOthersByThemselves) {
  const BodyProportions character = MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9);
  std::vector<BodyMotion> clips = {StandingClip(100, 0), StandingClip(20, 0), StandingClip(20, 0)};
  for (BodyPose& pose : clips[1].poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += 0.4;  // stands on a chair
  }
  for (BodyPose& pose : clips[2].poses) {
    for (glm::dvec3& joint : pose.joints)
      joint = 0.5 * joint + glm::dvec3(0, 0.4, 0);  // a child's file with another floor
  }
  clips.push_back(StandingClip(4, 0));  // few frames, 10 cm lower than the others
  for (BodyPose& pose : clips[3].poses) {
    for (glm::dvec3& joint : pose.joints) joint.y -= 0.1;
  }
  const std::vector<BodyMotion> performed = PerformedBy(character, clips);
  const double scale = 0.9 / StandingHipHeight(clips[0].poses[0]);
  EXPECT_NEAR(performed[0].poses[0][Role::kLeftFoot].y, 0, 1e-12);
  EXPECT_NEAR(performed[1].poses[0][Role::kLeftFoot].y, 0.4 * scale, 1e-12);
  EXPECT_NEAR(performed[2].poses[0][Role::kLeftFoot].y, 0, 1e-12);
  EXPECT_NEAR(performed[3].poses[0][Role::kLeftFoot].y, 0, 1e-12) << "not below the floor";
}

}  // namespace
}  // namespace etude
