#include "engine/transitions/library/bridge_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Returns a neck bent forward by `degrees` in every frame.
BodyMotion WithNeckBent(double degrees) {
  BodyMotion motion = StandingClip(5, 0);
  for (BodyPose& pose : motion.poses) {
    const glm::dvec3 neck(0, std::cos(Radians(degrees)), std::sin(Radians(degrees)));
    pose[Role::kHead] = pose[Role::kShoulderCentre] + 0.25 * neck;
  }
  return motion;
}

/// Returns a neck that turns forward at `degrees_per_s`, from 10° behind.
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

TEST(FrameRatings, CountClipsAndFramesOfTheSameTags) {
  std::vector<TaggedClip> clips = {ClipOfLevels({0, 1, 2}, {}), ClipOfLevels({0, 0}, {})};
  clips[0].tags[2][3] = 1;
  const auto ratings = RateFrames(clips, PaperWeights());
  EXPECT_EQ(ratings[0][0].clips, 2);
  EXPECT_EQ(ratings[0][0].frames, 4);
  EXPECT_EQ(ratings[0][2].clips, 1);
  EXPECT_EQ(ratings[0][2].difference, 0) << "nothing to differ from";
}

TEST(FrameRatings, MeasureTheMeanSquareDistanceToOtherClips) {
  const std::vector<TaggedClip> clips = {ClipOfLevels({0.5, 0.1}, {}), ClipOfLevels({0.2, 0.9, 0.4}, {})};
  const auto ratings = RateFrames(clips, PaperWeights());
  EXPECT_NEAR(ratings[0][0].difference, std::sqrt((0.09 + 0.16 + 0.01) / 3), 1e-12);
  EXPECT_NEAR(ratings[1][1].difference, std::sqrt((0.16 + 0.64) / 2), 1e-12) << "its own clip does not count";
}

TEST(FrameRatings, AgreeWithALoopOverAllPairs) {
  const BodyMotion motions[] = {WavingClip(50), WavingClip(40, 0.7), WavingClip(60, 2)};
  const auto clips = TagClips(motions, PosedBody::kStandingHipHeight);
  const auto ratings = RateFrames(clips, PaperWeights());
  int checked = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (int f = 0; f < clips[c].FrameCount(); f += 7) {
      double sum = 0;
      int others = 0;
      for (std::size_t o = 0; o < clips.size(); ++o) {
        for (int g = 0; o != c && g < clips[o].FrameCount(); ++g) {
          if (clips[o].tags[g] != clips[c].tags[f]) continue;
          const double d = ComputeDistance(clips[c].grades[f], clips[o].grades[g], PaperWeights()).value;
          sum += d * d;
          ++others;
        }
      }
      if (others == 0) continue;
      EXPECT_NEAR(ratings[c][f].difference, std::sqrt(sum / others), 1e-7);
      ++checked;
    }
  }
  EXPECT_GT(checked, 10);
}

TEST(BridgeFrames, CanBeKeptToTheMostTypicalOfEachPose) {
  const BodyMotion motions[] = {WavingClip(50), WavingClip(40, 0.7)};
  TagRules rules;
  rules.most_per_class = 1;
  const auto all = TagClips(motions, PosedBody::kStandingHipHeight);
  const auto kept = TagClips(motions, PosedBody::kStandingHipHeight, rules);
  const auto ratings = RateFrames(all, PaperWeights());
  for (std::size_t c = 0; c < 2; ++c) {
    ASSERT_FALSE(kept[c].bridge_frames.empty());
    ASSERT_LT(kept[c].bridge_frames.size(), all[c].bridge_frames.size());
    for (int frame : kept[c].bridge_frames) {
      for (int other : all[c].bridge_frames) {
        if (all[c].tags[other] != all[c].tags[frame]) continue;
        EXPECT_LE(ratings[c][frame].difference, ratings[c][other].difference);
      }
    }
  }
}

}  // namespace

}  // namespace etude
