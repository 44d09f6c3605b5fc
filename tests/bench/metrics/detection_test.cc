#include "bench/metrics/detection.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

TEST(DetectionMetrics, CountTheTextbookConfusion) {
  // 3 right called right, 1 right missed, 2 wrong called right, 4 wrong called wrong.
  std::vector<JudgedEvent> events(10);
  for (int i = 0; i < 4; ++i) events[i].is_right = true;
  for (int i : {0, 1, 2, 4, 5}) events[i].called_right = true;
  const Confusion confusion = CountConfusion(events);
  EXPECT_EQ(confusion.true_positives, 3);
  EXPECT_EQ(confusion.false_negatives, 1);
  EXPECT_EQ(confusion.false_positives, 2);
  EXPECT_EQ(confusion.true_negatives, 4);
  EXPECT_DOUBLE_EQ(*Precision(confusion), 0.6);
  EXPECT_DOUBLE_EQ(*Recall(confusion), 0.75);
  EXPECT_DOUBLE_EQ(*F1(confusion), 2 * 0.6 * 0.75 / (0.6 + 0.75));
}

TEST(DetectionMetrics, AreMissingRatherThanZeroWhenThereIsNothingToCount) {
  EXPECT_FALSE(Precision({.true_positives = 0, .false_positives = 0, .false_negatives = 3, .true_negatives = 1}));
  EXPECT_FALSE(Recall({.true_positives = 0, .false_positives = 2, .false_negatives = 0, .true_negatives = 1}));
  EXPECT_FALSE(F1({.true_positives = 0, .false_positives = 0, .false_negatives = 0, .true_negatives = 5}));
  EXPECT_DOUBLE_EQ(*F1({.true_positives = 0, .false_positives = 0, .false_negatives = 3, .true_negatives = 1}), 0.0);
}

/// The definition itself: every pair of a right and a wrong event.
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
  // Three quick answers, four never: the median of those that answered is 0.2, the truth is unknown.
  const std::vector<Wait> waits = {{0.1, true}, {0.2, true}, {0.3, true}, {2, false},
                                   {2, false},  {2, false},  {2, false}};
  EXPECT_FALSE(KaplanMeierMedian(waits));
  EXPECT_EQ(*KaplanMeierMedian(std::vector<Wait>(waits.begin(), waits.begin() + 3)), 0.2);
  EXPECT_FALSE(KaplanMeierMedian({}));
}

}  // namespace
}  // namespace etude
