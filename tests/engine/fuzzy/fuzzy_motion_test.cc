#include "engine/fuzzy/fuzzy_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/engine/fuzzy/posed_body.h"

namespace etude {
namespace {

TEST(FuzzyMotion, SaysOfEveryFrameWhatItsPoseSays) {
  PosedBody body;
  BodyMotion motion{.rate_hz = 30, .poses = {body.Pose(), body.Pose()}};
  const FuzzyMotion fuzzy = FuzzifyMotion(motion, PosedBody::kStandingHipHeight);
  ASSERT_EQ(fuzzy.grades.size(), 2u);
  const PoseFeatures features = ComputeFeatures(body.Pose(), PosedBody::kStandingHipHeight);
  EXPECT_EQ(fuzzy.features[1].values, features.values);
  EXPECT_EQ(fuzzy.grades[1], Fuzzify(features));
  EXPECT_EQ(fuzzy.tags[1], ChooseTags(Fuzzify(features)));
  EXPECT_EQ(fuzzy.poses[1], "at rest");
}

TEST(FuzzyMotion, FollowsTheSystemThatItIsGiven) {
  BodyMotion motion{.rate_hz = 30, .poses = {PosedBody().Pose()}};
  FuzzySystem system = *LoadBuiltinFuzzySystem("gaussian", {});
  system.rules = {};
  const FuzzyMotion fuzzy = FuzzifyMotion(motion, PosedBody::kStandingHipHeight, system);
  EXPECT_EQ(fuzzy.poses[0], "") << "no rule";
  EXPECT_NE(fuzzy.grades[0], FuzzifyMotion(motion, PosedBody::kStandingHipHeight).grades[0]);
}

using Motion = std::vector<Grades>;

/// Returns `frames` frames of an arm that rises to `most` degrees and falls.
Motion ArmRaise(int frames, double most) {
  Motion motion;
  for (int i = 0; i < frames; ++i) {
    PoseFeatures pose;
    pose[Feature::kPosture] = 80;
    pose[Feature::kRH] = most * 0.5 * (1 - std::cos(2 * 3.14159265358979 * i / (frames - 1)));
    motion.push_back(Fuzzify(pose));
  }
  return motion;
}

double Similarity(const Motion& a, const Motion& b, const MotionSimilarityOptions& options = {}) {
  const auto similarity = ComputeMotionSimilarity(a, b, options);
  EXPECT_TRUE(similarity);
  return similarity.value_or(-1);
}

/// A second implementation by recursion over all warping paths without a band, for small motions only.
double BestPath(const Motion& a, const Motion& b, std::size_t i, std::size_t j) {
  const double cost = ComputeDistance(a[i], b[j], PaperWeights()).value;
  if (i == 0 && j == 0) return 2 * cost;
  double best = std::numeric_limits<double>::infinity();
  if (i > 0) best = std::min(best, BestPath(a, b, i - 1, j) + cost);
  if (j > 0) best = std::min(best, BestPath(a, b, i, j - 1) + cost);
  if (i > 0 && j > 0) best = std::min(best, BestPath(a, b, i - 1, j - 1) + 2 * cost);
  return best;
}

TEST(MotionSimilarity, IsTheBestOfAllWarpingPaths) {
  const Motion a = ArmRaise(6, 170), b = ArmRaise(7, 80);
  const double mean = BestPath(a, b, 5, 6) / 13;
  EXPECT_NEAR(Similarity(a, b, {.band = 1}), 1 / (1 + mean / kPaperThreshold), 1e-12);
}

TEST(MotionSimilarity, IsOneForAMotionAndItselfAndTheSameBothWays) {
  const Motion a = ArmRaise(40, 170), b = ArmRaise(57, 100);
  EXPECT_EQ(Similarity(a, a), 1);
  EXPECT_EQ(Similarity(a, b), Similarity(b, a));
  EXPECT_LT(Similarity(a, b), 1);
  EXPECT_GT(Similarity(a, b), 0);
}

TEST(MotionSimilarity, ForgivesTempoButNotAnotherMovement) {
  const Motion raise = ArmRaise(60, 170), slower = ArmRaise(90, 170), lower = ArmRaise(60, 45);
  EXPECT_GT(Similarity(raise, slower), 0.9);
  EXPECT_LT(Similarity(raise, lower), 0.6);
}

TEST(MotionSimilarity, IsOneHalfAtTheThreshold) {
  // Two still poses that differ by 0.4 in one term of weight 1.
  Grades a{}, b{};
  b[0] = kPaperThreshold;
  EXPECT_NEAR(Similarity(Motion(20, a), Motion(30, b)), 0.5, 1e-12);
}

TEST(MotionSimilarity, GivesUpOnlyBelowWhatIsAskedFor) {
  const Motion a = ArmRaise(40, 170), b = ArmRaise(40, 20);
  const double similarity = Similarity(a, b);
  EXPECT_EQ(ComputeMotionSimilarity(a, b, {.at_least = similarity}), similarity);
  EXPECT_EQ(ComputeMotionSimilarity(a, b, {.at_least = similarity * 1.0001}), std::nullopt);
}

TEST(MotionSimilarity, GivesUpWhereOnlyTheLastFramesDiffer) {
  // The best path costs nothing until the last frames, which must be paired.
  Motion a(20, Grades{}), b = a;
  b.back()[0] = kPaperThreshold;
  const double similarity = Similarity(a, b);
  EXPECT_NEAR(similarity, 1 / (1 + 1 / 40.0), 1e-12) << "one step of 40 costs the threshold";
  EXPECT_EQ(ComputeMotionSimilarity(a, b, {.at_least = 0.99}), std::nullopt);
  EXPECT_EQ(ComputeMotionSimilarity(b, a, {.at_least = 0.99}), std::nullopt);
  EXPECT_EQ(ComputeMotionSimilarity(a, b, {.at_least = 0.97}), similarity);
}

TEST(MotionSimilarity, HoldsForMotionsOfOneFrameAndOfNone) {
  const Motion a = ArmRaise(30, 90), still = {a.front()};
  EXPECT_EQ(Similarity(still, still), 1);
  EXPECT_EQ(Similarity(still, a), Similarity(a, still));
  EXPECT_EQ(Similarity(a, ArmRaise(2, 90), {.band = 0}), Similarity(ArmRaise(2, 90), a, {.band = 0}));
  EXPECT_FALSE(ComputeMotionSimilarity({}, a));
}

}  // namespace

}  // namespace etude
