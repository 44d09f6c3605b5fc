#include "bench/statistics/curves/curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

JudgedEvent Right(double score) { return {.is_right = true, .score = score}; }
JudgedEvent Wrong(double score) { return {.is_right = false, .score = score}; }

TEST(Confusion, CountTheTextbookConfusion) {
  // 3 right called right, 1 right missed, 2 wrong called right, 4 wrong called wrong.
  std::vector<JudgedEvent> events(10);
  for (int i = 0; i < 4; ++i) events[i].is_right = true;
  for (int i : {0, 1, 2, 4, 5}) events[i].called_right = true;
  const Confusion confusion = CountConfusion(events);
  EXPECT_EQ(confusion.true_positives, 3);
  EXPECT_EQ(confusion.false_negatives, 1);
  EXPECT_EQ(confusion.false_positives, 2);
  EXPECT_EQ(confusion.true_negatives, 4);
  EXPECT_DOUBLE_EQ(*PrecisionOf(confusion), 0.6);
  EXPECT_DOUBLE_EQ(*RecallOf(confusion), 0.75);
  EXPECT_DOUBLE_EQ(*F1(confusion), 2 * 0.6 * 0.75 / (0.6 + 0.75));
}

TEST(Confusion, GivesValuesThatAreMissingRatherThanZeroWhenThereIsNothingToCount) {
  EXPECT_FALSE(PrecisionOf({.true_positives = 0, .false_positives = 0, .false_negatives = 3, .true_negatives = 1}));
  EXPECT_FALSE(RecallOf({.true_positives = 0, .false_positives = 2, .false_negatives = 0, .true_negatives = 1}));
  EXPECT_FALSE(F1({.true_positives = 0, .false_positives = 0, .false_negatives = 0, .true_negatives = 5}));
  EXPECT_DOUBLE_EQ(*F1({.true_positives = 0, .false_positives = 0, .false_negatives = 3, .true_negatives = 1}), 0.0);
}

/// Returns the area by its definition: counts every pair of a right and a wrong event.
double PairCountingAuc(const std::vector<JudgedEvent>& events) {
  double won = 0, pairs = 0;
  for (const JudgedEvent& right : events) {
    for (const JudgedEvent& wrong : events) {
      if (!right.is_right || wrong.is_right) continue;
      ++pairs;
      won += right.score > wrong.score ? 1.0 : right.score == wrong.score ? 0.5 : 0.0;
    }
  }
  return won / pairs;
}

TEST(RocAuc, EqualsBruteForcePairCountingAlsoWithManyTies) {
  RandomStream random({.suite_seed = 1, .scenario = "auc", .trial = 0}, "events");
  for (int round = 0; round < 200; ++round) {
    std::vector<JudgedEvent> events(2 + random.IndexBelow(20));
    for (JudgedEvent& event : events) {
      event.is_right = random.Chance(0.4);
      event.score = static_cast<double>(random.IndexBelow(5)) / 4.0;
    }
    events[0].is_right = true;
    events[1].is_right = false;
    EXPECT_NEAR(*RocAuc(events), PairCountingAuc(events), 1e-12) << "round " << round;
  }
}

TEST(RocAuc, IsOneHalfOrZeroForPerfectBlindOrInvertedScores) {
  const auto with_scores = [](double right, double wrong) {
    return *RocAuc(std::vector<JudgedEvent>{{.is_right = true, .called_right = false, .score = right},
                                            {.is_right = false, .called_right = false, .score = wrong}});
  };
  EXPECT_EQ(with_scores(0.9, 0.1), 1.0);
  EXPECT_EQ(with_scores(0.5, 0.5), 0.5);
  EXPECT_EQ(with_scores(0.1, 0.9), 0.0);
}

TEST(RocAuc, IsMissingWithOneClassOnly) {
  EXPECT_FALSE(RocAuc(std::vector<JudgedEvent>{{.is_right = true, .called_right = true, .score = 1}}));
  EXPECT_FALSE(RocAuc({}));
}

/// Returns the area under a curve by trapezoids, a second way to compute RocAuc.
double AreaUnder(const std::vector<std::pair<double, double>>& curve) {
  double area = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += (curve[i].first - curve[i - 1].first) * 0.5 * (curve[i].second + curve[i - 1].second);
  }
  return area;
}

TEST(RocCurve, GoesThroughItsPointsEqualScoresInOneStep) {
  const std::vector<JudgedEvent> all = {Right(0.9), Wrong(0.7), Right(0.7), Wrong(0.1)};
  const auto curve = RocCurve(all);
  const std::vector<std::pair<double, double>> expected = {{0, 0}, {0, 0.5}, {0.5, 1}, {1, 1}};
  EXPECT_EQ(curve, expected);
  EXPECT_DOUBLE_EQ(AreaUnder(curve), 0.875) << "Mann-Whitney: (1 + 1 + ½ + 1) / 4";
  EXPECT_DOUBLE_EQ(*RocAuc(all), 0.875);
  EXPECT_TRUE(RocCurve(std::vector{Right(0.5)}).empty());
  EXPECT_TRUE(RocCurve({}).empty());
}

TEST(OperatedAt, IsAPointOfTheCurveWhereVerdictsFollowScores) {
  std::vector<JudgedEvent> all = {Right(0.9), Wrong(0.7), Right(0.7), Wrong(0.1)};
  for (JudgedEvent& one : all) one.called_right = one.score >= 0.8;
  EXPECT_EQ(*OperatedAt(all), (std::pair{0.0, 0.5}));
  EXPECT_FALSE(OperatedAt(std::vector{Right(0.5)}));
  // At threshold 0.7: two hits and one false alarm, 2·2 / (2·2 + 1).
  EXPECT_DOUBLE_EQ(*BestF1(all), 0.8);
  EXPECT_FALSE(BestF1(std::vector{Right(0.5)}));
}

TEST(JackknifedAuc, HasAnIntervalOverGroups) {
  std::vector<JudgedEvent> alike, different;
  std::vector<int> groups;
  for (int group = 0; group < 6; ++group) {
    groups.insert(groups.end(), 2, group);
    for (auto* all : {&alike, &different}) all->push_back(Wrong(0.5));
    alike.push_back(Right(0.9));
    different.push_back(Right(group % 2 == 0 ? 0.9 : 0.1));
  }
  EXPECT_NEAR(JackknifedAuc(alike, groups)->value, 1, 1e-12);
  EXPECT_NEAR(JackknifedAuc(alike, groups)->low, 1, 1e-6);
  EXPECT_DOUBLE_EQ(JackknifedAuc(different, groups)->value, 0.5);
  // Without one of the three winners the area is 2/5; without one of the losers, 3/5. The jackknife's standard error is
  // therefore √(5/6 · 6 · 0.01).
  EXPECT_NEAR(JackknifedAuc(different, groups)->low, 0.5 - 1.96 * std::sqrt(0.05), 1e-12);
  EXPECT_FALSE(JackknifedAuc(std::vector{Right(0.9), Wrong(0.1)}, std::vector{0, 1}))
      << "a group is needed for the curve";
}

TEST(SurvivalCurve, IsTheEstimateOfKaplanAndMeier) {
  // Remission under 6-mercaptopurine (Freireich et al. 1963): 6, 6, 6, 6+, 7, 9+, 10, 10+, 11+, 13, 16, 17+, …
  const std::vector<Wait> waits = {{6, true},   {6, true},   {6, true},   {6, false}, {7, true},   {9, false},
                                   {10, true},  {10, false}, {11, false}, {13, true}, {16, true},  {17, false},
                                   {19, false}, {20, false}, {22, true},  {23, true}, {25, false}, {32, false},
                                   {32, false}, {34, false}, {35, false}};
  const auto curve = SurvivalCurve(waits);
  const std::vector<std::pair<double, double>> published = {{6, 1},      {6, 0.857},  {7, 0.807},  {10, 0.753},
                                                            {13, 0.690}, {16, 0.627}, {22, 0.538}, {23, 0.448}};
  ASSERT_EQ(curve.size(), published.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(curve[i].first, published[i].first);
    EXPECT_NEAR(curve[i].second, published[i].second, 5e-4);
  }
  EXPECT_TRUE(SurvivalCurve({}).empty());
}

constexpr Wait kNever = {std::numeric_limits<double>::infinity(), false};

TEST(SurvivalCurve, FallsAtEachTimeAndKeepsWhatNeverIs) {
  EXPECT_THAT(SurvivalCurve(std::vector<Wait>{{3, true}, {1, true}, kNever, {3, true}}),
              ElementsAre(::testing::Pair(1, 1), ::testing::Pair(1, 0.75), ::testing::Pair(3, DoubleEq(0.25))));
  EXPECT_THAT(SurvivalCurve(std::vector<Wait>{kNever, kNever}), ElementsAre(::testing::Pair(kNever.seconds, 1)));
}

// With a common limit the curve is the share that remains. The product over distinct times gives the same curve.
TEST(SurvivalCurve, IsTheShareOfWhatIsLeftWhereAllAreCensoredAtOneLimit) {
  const std::vector<Wait> waits{{2, true}, {2, true}, {5, true}, {7, true}, {7, true},
                                {7, true}, {9, true}, kNever,    kNever,    kNever};
  double share = 1;
  const auto curve = SurvivalCurve(waits);
  ASSERT_EQ(curve.size(), 5u);
  for (const auto& [at, left] : std::vector(curve.begin() + 1, curve.end())) {
    int at_risk = 0, done = 0;
    for (const Wait& wait : waits) {
      at_risk += wait.seconds >= at;
      done += wait.seconds == at;
    }
    share *= 1 - static_cast<double>(done) / at_risk;
    EXPECT_NEAR(left, share, 1e-11);
    EXPECT_NEAR(left, (at_risk - done) / 10.0, 1e-11);
  }
}

TEST(KaplanMeier, FindsTheMedianOfFreireichsLeukaemiaTrial) {
  // Remission times in weeks (Freireich et al. 1963; Cox and Oakes 1984, table 1.1): the published
  // Kaplan–Meier medians are 23 weeks under 6-mercaptopurine and 8 under placebo.
  const std::vector<Wait> treated = {{6, true},   {6, true},   {6, true},   {6, false}, {7, true},   {9, false},
                                     {10, true},  {10, false}, {11, false}, {13, true}, {16, true},  {17, false},
                                     {19, false}, {20, false}, {22, true},  {23, true}, {25, false}, {32, false},
                                     {32, false}, {34, false}, {35, false}};
  EXPECT_EQ(*KaplanMeierMedian(treated), 23);
  std::vector<Wait> placebo;
  for (double weeks : {1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23}) {
    placebo.push_back({weeks, true});
  }
  EXPECT_EQ(*KaplanMeierMedian(placebo), 8);
}

TEST(KaplanMeier, DoesNotFallForDroppingTheMisses) {
  // Three quick answers and four that never came: the median of the answers is 0.2, but the true median is unknown.
  const std::vector<Wait> waits = {{0.1, true}, {0.2, true}, {0.3, true}, {2, false},
                                   {2, false},  {2, false},  {2, false}};
  EXPECT_FALSE(KaplanMeierMedian(waits));
  EXPECT_EQ(*KaplanMeierMedian(std::vector<Wait>(waits.begin(), waits.begin() + 3)), 0.2);
  EXPECT_FALSE(KaplanMeierMedian({}));
}

}  // namespace
}  // namespace etude
