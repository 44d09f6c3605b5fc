#include "reports/plots/verdict_curves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

JudgedPerformance Right(double score, int person = 0) { return {.person = person, .score = score, .truth = 1}; }
JudgedPerformance Wrong(double score, int person = 0) { return {.person = person, .score = score, .truth = 0}; }

std::vector<JudgedPerformance> FourAndAGreyOne() {
  return {Right(0.9), Wrong(0.7), Right(0.7), Wrong(0.1), {.score = 0.8, .truth = 0.5}};
}

TEST(PooledRoc, GoesThroughItsPointsAndLeavesOutWhatIsGrey) {
  const std::vector<JudgedPerformance> all = FourAndAGreyOne();
  const auto curve = PooledRoc(all);
  const std::vector<std::pair<double, double>> expected = {{0, 0}, {0, 0.5}, {0.5, 1}, {1, 1}};
  EXPECT_EQ(curve, expected);
  EXPECT_DOUBLE_EQ(AreaUnder(curve), 0.875) << "Mann-Whitney: (1 + 1 + ½ + 1) / 4";
  EXPECT_TRUE(PooledRoc(std::vector{Right(0.5)}).empty());
}

TEST(OperatedAt, IsAPointOfTheCurveWhereVerdictsFollowScores) {
  std::vector<JudgedPerformance> all = FourAndAGreyOne();
  for (JudgedPerformance& one : all) one.is_called = one.score >= 0.8;
  EXPECT_EQ(*OperatedAt(all), (std::pair{0.0, 0.5}));
  EXPECT_FALSE(OperatedAt(std::vector{Right(0.5)}));
  // From 0.7 on: two hits and one false, 2·2 / (2·2 + 1).
  EXPECT_DOUBLE_EQ(*BestF1(all), 0.8);
}

TEST(StillWaiting, IsTheEstimateOfKaplanAndMeier) {
  // Remission under 6-mercaptopurine (Freireich et al. 1963): 6, 6, 6, 6+, 7, 9+, 10, 10+, 11+, 13, 16, 17+, …
  std::vector<PraiseWait> waits = {{6, true},   {6, true},   {6, true},   {6, false}, {7, true},   {9, false},
                                   {10, true},  {10, false}, {11, false}, {13, true}, {16, true},  {17, false},
                                   {19, false}, {20, false}, {22, true},  {23, true}, {25, false}, {32, false},
                                   {32, false}, {34, false}, {35, false}};
  const auto curve = StillWaiting(waits);
  const std::vector<std::pair<double, double>> published = {{6, 1},      {6, 0.857},  {7, 0.807},  {10, 0.753},
                                                            {13, 0.690}, {16, 0.627}, {22, 0.538}, {23, 0.448}};
  ASSERT_EQ(curve.size(), published.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(curve[i].first, published[i].first);
    EXPECT_NEAR(curve[i].second, published[i].second, 5e-4);
  }
  EXPECT_TRUE(StillWaiting({}).empty());
}

TEST(PooledArea, HasAnIntervalOverPeople) {
  std::vector<JudgedPerformance> alike, different;
  for (int person = 0; person < 6; ++person) {
    for (auto* all : {&alike, &different}) all->push_back(Wrong(0.5, person));
    alike.push_back(Right(0.9, person));
    different.push_back(Right(person % 2 == 0 ? 0.9 : 0.1, person));
  }
  EXPECT_NEAR(PooledArea(alike)->value, 1, 1e-12);
  EXPECT_NEAR(PooledArea(alike)->low, 1, 1e-6);
  EXPECT_DOUBLE_EQ(PooledArea(different)->value, 0.5);
  // Without one of three that win, 2/5; of three that lose, 3/5: √(5/6 · 6 · 0.01) either way, twice nearly.
  EXPECT_NEAR(PooledArea(different)->low, 0.5 - 1.96 * std::sqrt(0.05), 1e-12);
  EXPECT_FALSE(PooledArea(std::vector{Right(0.9, 0), Wrong(0.1, 1)})) << "a person is needed for the curve";
}

TEST(FoundBySeverity, CountsFaultsInFifths) {
  std::vector<JudgedPerformance> all;
  for (double severity : {0.1, 0.15, 0.5, 0.55, 0.9, 1.0})
    all.push_back({.is_called = severity < 0.53, .severity = severity});
  all.push_back({.is_called = true, .severity = 0});
  const auto curve = FoundBySeverity(all);
  const std::vector<std::pair<double, double>> expected = {{0.1, 0}, {0.5, 0.5}, {0.9, 1}};
  EXPECT_EQ(curve, expected);
  EXPECT_DOUBLE_EQ(*HalfFoundAt(curve), 0.5);
  EXPECT_FALSE(HalfFoundAt(std::vector<std::pair<double, double>>{{0.1, 0.6}, {0.9, 0.7}}));
}

}  // namespace
}  // namespace etude
