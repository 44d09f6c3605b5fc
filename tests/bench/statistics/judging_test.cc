#include "bench/statistics/judging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "bench/statistics/compare.h"
#include "bench/statistics/scenario_table.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::optional<double>> Corrected(std::vector<std::optional<double>> p_values) {
  return HolmCorrected(p_values);
}

TEST(Holm, AgreesWithR) {
  // R: p.adjust(c(0.01, 0.02, 0.03, 0.04, 0.05), "holm") and p.adjust(c(0.04, 0.001, 0.03), "holm")
  const auto rising = Corrected({0.01, 0.02, 0.03, 0.04, 0.05});
  const double expected[] = {0.05, 0.08, 0.09, 0.09, 0.09};
  for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(*rising[i], expected[i]);
  const auto mixed = Corrected({0.04, 0.001, 0.03});
  EXPECT_DOUBLE_EQ(*mixed[0], 0.06);
  EXPECT_DOUBLE_EQ(*mixed[1], 0.003);
  EXPECT_DOUBLE_EQ(*mixed[2], 0.06);
}

TEST(Holm, NeverExceedsOneNorForgetsAQuestion) {
  const auto corrected = Corrected({0.9, std::nullopt, 0.02});
  EXPECT_EQ(*corrected[0], 1);
  EXPECT_FALSE(corrected[1]);
  EXPECT_DOUBLE_EQ(*corrected[2], 0.06);  // three comparisons, although one has no p
  EXPECT_TRUE(Corrected({}).empty());
}


Comparison Compared(const std::vector<double>& differences, const char* metric = "position_error_cm") {
  std::vector<etude::Pair> pairs;
  for (double difference : differences) pairs.push_back({0, difference});
  Comparison comparison = ComparePaired(pairs, *FindMetric(metric), 1, "x");
  comparison.baseline = "fixed";
  comparison.method = "adaptive";
  return comparison;
}

std::vector<double> Falling(int count) {
  std::vector<double> differences;
  for (int i = 1; i <= count; ++i) differences.push_back(-1 - 0.01 * i);
  return differences;
}

void Judge(std::vector<Question>& questions) {
  std::vector<Question*> family;
  for (Question& question : questions) family.push_back(&question);
  JudgeFamily(family);
}

/// Returns the first of `count` comparisons after the correction; the others show nothing.
Comparison JudgedAmong(int count, const Comparison& first, const std::optional<Comparison>& with_failures = {}) {
  std::vector<Question> all(count, Question{Compared(std::vector<double>(20, 0.0)), {}});
  all[0] = {first, with_failures};
  Judge(all);
  return all[0].comparison;
}

TEST(JudgeFamily, TakesBackWhatManyQuestionsWouldFindByChance) {
  const Comparison seven = Compared(Falling(7));  // p = 2 / 128
  EXPECT_EQ(JudgedAmong(1, seven).verdict, Verdict::kBetter);
  EXPECT_EQ(JudgedAmong(3, seven).verdict, Verdict::kBetter);
  EXPECT_EQ(JudgedAmong(4, seven).verdict, Verdict::kUndecided);
  EXPECT_DOUBLE_EQ(*JudgedAmong(4, seven).p_holm, 8.0 / 128);
}

TEST(JudgeFamily, SaysHowManyPairsItTakes) {
  EXPECT_EQ(JudgedAmong(12, Compared(Falling(8))).why_open,
            "too few worlds: 8 of 8 pairs differ, so p ≥ 0.0078; one of 12 comparisons (Holm) needs at least 9");
  EXPECT_EQ(JudgedAmong(12, Compared(Falling(9))).verdict, Verdict::kBetter);
  EXPECT_THAT(JudgedAmong(12, Compared(Falling(9))).why_open, IsEmpty());
  EXPECT_THAT(JudgedAmong(1, Compared(Falling(5))).why_open, HasSubstr("one comparison needs at least 6"));
  EXPECT_THAT(JudgedAmong(1, Compared({})).why_open, HasSubstr("no world"));
}

TEST(JudgeFamily, SaysWhyADifferenceIsNotYetAVerdict) {
  std::vector<double> mostly_lower = Falling(20);
  for (int rank : {5, 9, 13, 15}) mostly_lower[rank - 1] *= -1;
  const Comparison noisy = Compared(mostly_lower);
  ASSERT_LT(*noisy.signed_rank.p, 0.05);
  ASSERT_LT(*noisy.ci_high, 0);
  EXPECT_THAT(JudgedAmong(40, noisy).why_open, HasSubstr("but not among 40 comparisons (Holm)"));
  // The threshold of a jump is 1 cm; the differences are certain, but their interval contains 1 cm.
  RandomStream dice({.suite_seed = 4, .scenario = "small", .trial = 0}, "x");
  std::vector<double> small(40);
  for (double& difference : small) difference = dice.Normal(-0.95, 0.6);
  const Comparison open = JudgedAmong(1, Compared(small, "jump_cm"));
  EXPECT_EQ(open.verdict, Verdict::kUndecided);
  EXPECT_EQ(open.why_open, "there is a difference, but it is undecided whether it is large enough to matter");
}

TEST(JudgeFamily, TellsATestThatFoundSomethingFromOneThatDidNot) {
  // Equal worlds and small wins: the ranks are clear, but the interval of the median contains zero.
  std::vector<double> steps(24, 0.0);
  for (int i = 0; i < 13; ++i) steps[i] = -1 - 0.01 * i;
  const Comparison found = JudgedAmong(2, Compared(steps));
  EXPECT_EQ(found.verdict, Verdict::kUndecided);
  EXPECT_THAT(found.why_open, HasSubstr("the test finds a difference (p = 0.00049 among 2), but the interval of its "
                                        "median reaches zero"));
  // In twelve worlds, both methods have the same value of a share: no pair differs, but the interval is wide.
  std::vector<etude::Pair> equal(12, etude::Pair{1, 1});
  Comparison same = ComparePaired(equal, *FindMetric("solved_practical"), 1, "x");
  EXPECT_EQ(JudgedAmong(1, same).why_open,
            "no pair differs, but 12 worlds are too few to exclude a difference that matters");
}

TEST(JudgeFamily, WarnsOfWorldsThatOnlyOneSurvived) {
  Comparison lossy = Compared(Falling(20));
  lossy.only_baseline = 7;
  lossy.neither = 1;
  EXPECT_THAT(
      JudgedAmong(1, lossy).notes,
      ElementsAre("the difference does not include 8 of 28 worlds: only “fixed” has a value in 7, neither has one in 1 "
                  "(survivorship bias)"));
  lossy.only_baseline = 0;
  EXPECT_THAT(JudgedAmong(1, lossy).notes,
              ElementsAre("the difference does not include 1 of 21 worlds: neither has one in 1"));
}

TEST(JudgeFamily, FindsNobodyBetterWhoFailsWhereTheOtherDoesNot) {
  PairedWorlds pairs;
  for (double difference : Falling(20)) pairs.pairs.push_back({0, difference});
  pairs.trials.resize(20);
  const MetricInfo& metric = *FindMetric("position_error_cm");
  const auto judged = [&](std::size_t baseline_failed, std::size_t method_failed) {
    PairedWorlds worlds = pairs;
    worlds.baseline_failed.resize(baseline_failed);
    worlds.method_failed.resize(method_failed);
    return JudgedAmong(1, Compared(Falling(20)), ComparePaired(WithFailures(worlds, metric)->pairs, metric, 1, "x"));
  };
  // The method wins twenty worlds. Two failures of the method leave the verdict better; twelve make it undecided. A
  // failure of the baseline counts as a win of the method.
  EXPECT_EQ(judged(0, 2).verdict, Verdict::kBetter);
  EXPECT_EQ(judged(20, 0).verdict, Verdict::kBetter);
  const Comparison open = judged(0, 12);
  EXPECT_EQ(open.verdict, Verdict::kUndecided);
  EXPECT_EQ(open.why_open, "“better” in worlds in which both have a value, but not if a failure counts as a loss");
  EXPECT_GT(*open.p_holm, 0.05);
  EXPECT_DOUBLE_EQ(*open.difference, *Compared(Falling(20)).difference);
}

TEST(JudgeFamily, CallsNobodyEqualWhoLosesValues) {
  // In every world with both values, the values are nearly equal.
  std::vector<double> nearly(40);
  for (std::size_t i = 0; i < nearly.size(); ++i) nearly[i] = i % 2 == 0 ? 1e-6 : -1e-6;
  Comparison lossy = Compared(nearly);
  EXPECT_EQ(JudgedAmong(1, lossy).verdict, Verdict::kNoDifference);
  lossy.only_baseline = 3;  // mid-p = 1/8
  EXPECT_EQ(JudgedAmong(1, lossy).verdict, Verdict::kNoDifference);
  lossy.only_baseline = 11;
  const Comparison open = JudgedAmong(1, lossy);
  EXPECT_EQ(open.verdict, Verdict::kUndecided);
  EXPECT_THAT(open.why_open, HasSubstr("only “fixed” has a value in 11 worlds"));
  lossy.only_method = 11;  // both lose equally many
  EXPECT_EQ(JudgedAmong(1, lossy).verdict, Verdict::kNoDifference);
}

TEST(JudgeFamily, CallsAMeanEqualOnlyWhenEnoughPairsDiffer) {
  std::vector<double> steps(40, 0.0);
  for (int i = 0; i < 5; ++i) steps[i] = 2;
  const Comparison few = JudgedAmong(1, Compared(steps, "iterations_par2"));
  EXPECT_EQ(few.verdict, Verdict::kUndecided);
  EXPECT_EQ(few.why_open,
            "only 5 of 40 pairs differ; rare differences that would change the mean may be missing among them");
  steps[5] = 2;
  EXPECT_EQ(JudgedAmong(1, Compared(steps, "iterations_par2")).verdict, Verdict::kNoDifference);
  EXPECT_EQ(JudgedAmong(1, Compared(std::vector<double>(40, 0.0), "iterations")).verdict, Verdict::kNoDifference);
}

TEST(JudgeFamily, CallsNothingEqualOfWhichTheMedianHidesWhatFewWorldsShow) {
  std::vector<double> rare(40, 0.0);
  for (int i = 0; i < 12; ++i) rare[i] = 50 + i;
  const Comparison judged = JudgedAmong(1, Compared(rare));
  EXPECT_EQ(judged.verdict, Verdict::kUndecided);
  EXPECT_EQ(*judged.ci_high, 0);
  EXPECT_THAT(judged.why_open, HasSubstr("in most worlds the same, in 0 of 40 better, in 12 worse"));
  EXPECT_THAT(judged.notes, ElementsAre(HasSubstr("which the median does not show")));
  // The control: the same ties, with differences below the threshold.
  for (double& difference : rare) difference *= 1e-4;
  EXPECT_EQ(JudgedAmong(1, Compared(rare)).verdict, Verdict::kNoDifference);
}

/// Returns in how many of 100 scenarios of twelve comparisons a difference is found.
int FalseAlarms(double effect, bool corrected) {
  int alarms = 0;
  for (int scenario = 0; scenario < 100; ++scenario) {
    std::vector<Question> all;
    for (int c = 0; c < 12; ++c) {
      RandomStream dice({.suite_seed = 4, .scenario = "family", .trial = scenario * 12 + c}, "x");
      std::vector<double> differences(20);
      for (double& difference : differences) difference = dice.Normal(effect, 1);
      all.push_back({Compared(differences), {}});
    }
    if (corrected) Judge(all);
    const auto is_clear = [](const Question& question) {
      return question.comparison.verdict == Verdict::kBetter || question.comparison.verdict == Verdict::kWorse;
    };
    const bool alarm = std::any_of(all.begin(), all.end(), is_clear);
    alarms += alarm;
  }
  return alarms;
}

TEST(JudgeFamily, HEAVY_RaisesAFalseAlarmInOneScenarioOfTwenty) {
  EXPECT_LE(FalseAlarms(0, true), 10);
  // The controls: without the correction many scenarios have a false alarm; a true effect is found.
  EXPECT_GE(FalseAlarms(0, false), 25);
  EXPECT_GE(FalseAlarms(-1, true), 95);
}

/// Returns the result of "a" against "base" under one law and one noise.
ConditionSummary Under(const std::string& law, const std::string& noise, Verdict verdict, double difference) {
  ConditionSummary condition{.condition = {{"learning", law}, {"noise", noise}}};
  Comparison comparison;
  comparison.metric = "retention";
  comparison.baseline = "base";
  comparison.method = "a";
  comparison.verdict = verdict;
  comparison.difference = difference;
  condition.comparisons.push_back(comparison);
  return condition;
}

Study Asking(std::vector<std::string> across) {
  Study study{.across = std::move(across)};
  return study;
}

TEST(Across, AVerdictHoldsWhereItIsTheSameUnderEveryValue) {
  const auto verdicts =
      JudgeAcross(Asking({"learning"}),
                  {Under("power", "0", Verdict::kBetter, 0.1), Under("power", "1", Verdict::kBetter, 0.1),
                   Under("two-rate", "0", Verdict::kBetter, 0.2), Under("two-rate", "1", Verdict::kWorse, -0.2)});
  ASSERT_EQ(verdicts.size(), 2u);  // one verdict per noise
  EXPECT_EQ(verdicts[0].condition, (std::vector<SweptValue>{{"noise", "0"}}));
  EXPECT_EQ(verdicts[0].verdict, Verdict::kBetter);
  EXPECT_TRUE(verdicts[0].Holds());
  ASSERT_EQ(verdicts[0].each.size(), 2u);
  EXPECT_EQ(verdicts[0].each[1].value, "learning=two-rate");
  EXPECT_EQ(verdicts[0].each[1].difference, 0.2);
  EXPECT_FALSE(verdicts[1].Holds());  // better under one law, worse under the other
}

TEST(Across, OneLawThatSaysNothingIsEnoughToSayNothing) {
  const auto verdicts = JudgeAcross(Asking({"learning"}), {Under("power", "0", Verdict::kBetter, 0.1),
                                                           Under("two-rate", "0", Verdict::kUndecided, 0.0),
                                                           Under("exponential", "0", Verdict::kBetter, 0.1)});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].verdict, Verdict::kUndecided);
}

TEST(Across, NoDifferenceHoldsToo) {
  const auto verdicts = JudgeAcross(Asking({"learning"}), {Under("power", "0", Verdict::kNoDifference, 0),
                                                           Under("two-rate", "0", Verdict::kNoDifference, 0)});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(verdicts[0].Holds());
}

TEST(Across, AStudyThatAsksForNothingGetsNothing) {
  EXPECT_TRUE(JudgeAcross(Asking({}), {Under("power", "0", Verdict::kBetter, 0.1)}).empty());
}

}  // namespace
}  // namespace etude
