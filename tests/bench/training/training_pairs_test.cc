#include "bench/training/training_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/bridging/test_clips.h"

namespace etude {
namespace {

TEST(TrainingPairs, AreLabelledByTheirTruePoseGap) {
  // Straight arms of 0.48 m: 10° apart is a gap of 8 cm, 30° apart one of 25 cm.
  BodyMotion first = StandingClip(1, 60), second = StandingClip(1, 70);
  second.poses.push_back(StandingClip(1, 90).poses[0]);
  const BodyMotion clips[] = {first, second};
  const auto tagged = TagClips(clips, PosedBody::kStandingHipHeight);
  const auto pairs = LabelPairs({&first, &tagged[0]}, {&second, &tagged[1]});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_TRUE(pairs[0].close);
  EXPECT_FALSE(pairs[1].close);
  EXPECT_NEAR(pairs[0].squared_gaps[0], 2 * (10.0 / 70) * (10.0 / 70), 1e-12) << "down and mid";
}

TEST(TrainingPairs, SampleLongClipsEvenly) {
  const BodyMotion clips[] = {WavingClip(1000), WavingClip(7)};
  const auto tagged = TagClips(clips, PosedBody::kStandingHipHeight);
  EXPECT_EQ(LabelPairs({&clips[0], &tagged[0]}, {&clips[1], &tagged[1]}).size(), 16u * 7u);
  EXPECT_EQ(LabelPairs({&clips[0], &tagged[0]}, {&clips[0], &tagged[0]}, {.frames_per_clip = 10}).size(), 100u);
}

}  // namespace
}  // namespace etude
