#include "bench/training/training_pairs.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

std::vector<TrainingFrame> Frames(const BodyMotion& motion) {
  std::vector<TrainingFrame> frames;
  for (const BodyPose& pose : motion.poses) {
    frames.push_back({pose, ComputeFeatures(pose, PosedBody::kStandingHipHeight)});
  }
  return frames;
}

TEST(TrainingPairs, AreLabelledByTheirTruePoseGap) {
  // Straight arms of 0.48 m: 10° apart is a gap of 8 cm, 30° apart one of 25 cm.
  BodyMotion second = StandingClip(1, 70);
  second.poses.push_back(StandingClip(1, 90).poses[0]);
  const auto pairs = LabelPairs(Frames(StandingClip(1, 60)), Frames(second));
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_TRUE(pairs[0].close);
  EXPECT_FALSE(pairs[1].close);
  EXPECT_NEAR(pairs[0].squared_gaps[0], 2 * (10.0 / 70) * (10.0 / 70), 1e-12) << "down and mid";
}

TEST(TrainingPairs, GoByTheMembershipsThatAreAskedAbout) {
  Memberships crisp = PaperMemberships();
  crisp.shapes[FirstTermOf(Feature::kRH)] = Trapezoidal{0, 0, 65, 65};
  const auto pairs = LabelPairs(Frames(StandingClip(1, 60)), Frames(StandingClip(1, 70)), crisp);
  EXPECT_NEAR(pairs[0].squared_gaps[0], 1 + (10.0 / 70) * (10.0 / 70), 1e-12) << "down ends at 65°";
  EXPECT_NEAR(pairs[0].squared_gaps[1], 2 * (10.0 / 70) * (10.0 / 70), 1e-12) << "the left arm's are the paper's";
}

TEST(TrainingPairs, AcrossClipsLeaveOutThoseWithinOne) {
  const std::vector<TrainingFrame> clips[] = {Frames(StandingClip(2, 10)), Frames(StandingClip(3, 50)),
                                              Frames(StandingClip(4, 90))};
  EXPECT_EQ(LabelPairsAcross(clips).size(), 2u * 3 + 2 * 4 + 3 * 4);
}

TEST(TrainingClips, SampleLongClipsEvenly) {
  const BodyProportions proportions = MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight);
  const BodyMotion clips[] = {WavingClip(1000), WavingClip(7)};
  const TrainingClips training = SampleClips({"long", "short"}, clips, proportions);
  ASSERT_EQ(training.frames.size(), 2u);
  EXPECT_EQ(training.frames[0].size(), 16u);
  EXPECT_EQ(training.frames[1].size(), 7u);
  const BodyMotion danced = PerformedBy(proportions, clips).front();
  EXPECT_EQ(training.frames[0][0].pose.joints, danced.poses[31].joints) << "the middle of the first sixteenth";
  EXPECT_EQ(training.frames[0][15].pose.joints, danced.poses[968].joints);
}

}  // namespace
}  // namespace etude
