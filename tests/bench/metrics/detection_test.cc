#include "bench/metrics/detection.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

std::vector<Moment> At(const std::string& move, const std::vector<double>& times) {
  std::vector<Moment> moments;
  for (const double time : times) moments.push_back({move, time});
  return moments;
}

TEST(ActionPoints, ADetectionCountsWithinTheToleranceOnItsBorderToo) {
  const std::vector<Moment> point = At("wave", {5});
  EXPECT_EQ(MatchMoments(point, At("wave", {5.333}), 0.333).matched, 1);
  EXPECT_EQ(MatchMoments(point, At("wave", {4.667}), 0.333).matched, 1);
  EXPECT_EQ(MatchMoments(point, At("wave", {5.334}), 0.333).matched, 0);
  EXPECT_EQ(MatchMoments(point, At("clap", {5}), 0.333).matched, 0);
}

TEST(ActionPoints, EachPointHasOneDetectionAndTheRestAreFalse) {
  const MomentMatch match = MatchMoments(At("wave", {5}), At("wave", {4.9, 5, 5.1}), 0.333);
  EXPECT_EQ(match.matched, 1);
  // By hand: F = 2·1 / (1 + 3).
  EXPECT_DOUBLE_EQ(*match.FScore(), 0.5);
}

TEST(ActionPoints, AsManyPairsAsCanBe) {
  // Greedy matching by distance would pair only 5.2 with 5.3.
  EXPECT_EQ(MatchMoments(At("wave", {5.0, 5.3}), At("wave", {5.2, 5.6}), 0.333).matched, 2);
}

TEST(ActionPoints, TheMeanIsOverMovesNotOverPoints) {
  std::vector<Moment> points = At("wave", {1, 2, 3, 4}), detections = At("wave", {1, 2, 3, 4});
  points.push_back({"clap", 9});
  EXPECT_DOUBLE_EQ(*MeanFScore(points, detections, 0.333), 0.5);
  EXPECT_DOUBLE_EQ(*MatchMoments(points, detections, 0.333).FScore(), 8.0 / 9);
  EXPECT_FALSE(MeanFScore({}, {}, 0.333));
}

}  // namespace
}  // namespace etude
