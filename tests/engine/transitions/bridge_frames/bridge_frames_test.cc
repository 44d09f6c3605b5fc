#include "engine/transitions/bridge_frames/bridge_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The neck bent forward by `degrees` in every frame.
BodyMotion WithNeckBent(double degrees) {
  BodyMotion motion = StandingClip(5, 0);
  for (BodyPose& pose : motion.poses) {
    const glm::dvec3 neck(0, std::cos(Radians(degrees)), std::sin(Radians(degrees)));
    pose[Role::kHead] = pose[Role::kShoulderCentre] + 0.25 * neck;
  }
  return motion;
}

/// The neck goes forward by `degrees_per_s`, from 10° behind.
BodyMotion WithNeckTurning(double degrees_per_s) {
  BodyMotion motion = StandingClip(7, 0);
  for (int f = 0; f < 7; ++f) motion.poses[f] = WithNeckBent(-10 + degrees_per_s * f / 30).poses[0];
  return motion;
}

TEST(HeadRule, ExcludesFramesWithTheNeckBentMoreThan30Degrees) {
  EXPECT_THAT(FindQuietHeads(WithNeckBent(29)), Each(true));
  EXPECT_THAT(FindQuietHeads(WithNeckBent(31)), Each(false));
}

TEST(HeadRule, ExcludesFramesWithTheNeckTurningFasterThan60DegreesPerSecond) {
  EXPECT_THAT(FindQuietHeads(WithNeckTurning(58)), Each(true));
  EXPECT_THAT(FindQuietHeads(WithNeckTurning(62)), Each(false));
}

TEST(HeadRule, DoesNotMindABodyThatTurnsAsAWhole) {
  BodyMotion motion = WithNeckBent(20);
  for (int f = 0; f < 5; ++f) motion.poses[f] = FloorMove{.yaw = 0.5 * f}.Apply(motion.poses[f]);
  EXPECT_THAT(FindQuietHeads(motion), Each(true));
}

TEST(HeadRule, StaysFiniteForABodyCollapsedToAPoint) {
  EXPECT_EQ(FindQuietHeads({kJudgedRateHz, std::vector<BodyPose>(3)}).size(), 3u);
}

TEST(BridgeFrames, AreThoseWhoseTenTagsOccurInTwoClips) {
  BodyMotion first = StandingClip(2, 0);  // arms down, down, mid
  first.poses.push_back(StandingClip(1, 90).poses[0]);
  BodyMotion second = StandingClip(1, 170);  // up, down
  second.poses.push_back(StandingClip(1, 5).poses[0]);
  const BodyMotion clips[] = {first, second};
  const auto tagged = TagClips(clips, PosedBody::kStandingHipHeight);
  EXPECT_THAT(tagged[0].bridge_frames, ElementsAre(0, 1)) << "often in one clip is not enough";
  EXPECT_THAT(tagged[1].bridge_frames, ElementsAre(1));
}

TEST(BridgeFrames, OfALibraryWithOneClipAreNone) {
  const BodyMotion clips[] = {StandingClip(5, 0)};
  EXPECT_THAT(TagClips(clips, PosedBody::kStandingHipHeight)[0].bridge_frames, IsEmpty());
}

TEST(BridgeFrames, NeverMoveTheHead) {
  const BodyMotion clips[] = {StandingClip(5, 0), WithNeckBent(40)};
  const auto tagged = TagClips(clips, PosedBody::kStandingHipHeight);
  EXPECT_THAT(tagged[0].bridge_frames, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(tagged[1].bridge_frames, IsEmpty()) << "same tags, but the neck is bent";
}

}  // namespace
}  // namespace etude
