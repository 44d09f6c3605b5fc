#include "bench/training/training_pairs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random/stream.h"
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
  // Straight arms of 0.48 m: 10° apart is a gap of 8 cm, 30° apart is a gap of 25 cm.
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

std::vector<LabelledPair> RandomPairs(int count) {
  RandomStream dice({.scenario = "match-score"}, "pairs");
  std::vector<LabelledPair> pairs(static_cast<std::size_t>(count));
  for (LabelledPair& pair : pairs) {
    for (double& gap : pair.squared_gaps) gap = 0.1 * dice.Uniform() * dice.Uniform();
    pair.close = dice.Chance(0.2);
  }
  return pairs;
}

TEST(MatchScore, CountsLikeALoopOverEquation1) {
  const std::vector<LabelledPair> pairs = RandomPairs(1000);  // not a multiple of a block's size
  const FeatureWeights weights = {0, 2, 1, 0.5, 0, 1.5, 1, 1, 0.5, 0.5};
  const PairTable table(pairs);
  int checked = 0;
  for (double threshold : {0.2, 0.4, 0.6}) {
    MatchScore expected;
    for (const LabelledPair& pair : pairs) {
      double squared = 0;
      for (std::size_t k = 0; k < kFeatureCount; ++k) squared += weights[k] * pair.squared_gaps[k];
      const bool matched = std::sqrt(squared) < threshold;
      expected.matched += matched;
      expected.close += pair.close;
      expected.close_matched += matched && pair.close;
    }
    const MatchScore score = table.Score(weights, threshold);
    EXPECT_EQ(score.matched, expected.matched) << threshold;
    EXPECT_EQ(score.close, expected.close);
    EXPECT_EQ(score.close_matched, expected.close_matched);
    checked += expected.matched > 0 && expected.matched < 1000;
  }
  EXPECT_GE(checked, 2) << "thresholds that tell pairs apart";
}

TEST(MatchScore, SoftF1TendsToF1AsTheRampNarrows) {
  const PairTable table(RandomPairs(1000));
  const double hard = table.Score(PaperWeights()).F1();
  EXPECT_NEAR(table.SoftF1(PaperWeights(), kPaperThreshold, 1e-6), hard, 1e-6);
  EXPECT_GT(std::abs(table.SoftF1(PaperWeights(), kPaperThreshold, 0.5) - hard), 1e-3) << "control";
}

TEST(MatchScore, SoftF1CountsAPairOnTheThresholdByHalf) {
  LabelledPair on{.close = true}, far{.close = true};
  on.squared_gaps[0] = 0.16;
  far.squared_gaps[0] = 1;
  const LabelledPair pairs[] = {on, far};
  EXPECT_NEAR(PairTable(pairs).SoftF1(PaperWeights(), 0.4, 0.1), 2 * 0.5 / (0.5 + 2), 1e-6);
}

TEST(MatchScore, F1IsTheHarmonicMeanOfPrecisionAndRecall) {
  const MatchScore score{.matched = 8, .close = 12, .close_matched = 6};
  EXPECT_DOUBLE_EQ(score.F1(), 2 / (1 / (6.0 / 8) + 1 / (6.0 / 12)));
  EXPECT_EQ((MatchScore{.matched = 8, .close = 12, .close_matched = 0}).F1(), 0);
  EXPECT_EQ(MatchScore{}.F1(), 0) << "nothing asked, nothing known";
}

}  // namespace

}  // namespace etude
