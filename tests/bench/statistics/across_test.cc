#include "bench/statistics/across.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

/// "a" against "base" under one law and one noise.
ConditionSummary Under(const std::string& law, const std::string& noise, Verdict verdict, double difference) {
  ConditionSummary condition;
  condition.condition = {{"learning", law}, {"noise", noise}};
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
  Study study;
  study.across = std::move(across);
  return study;
}

TEST(Across, AVerdictHoldsWhereItIsTheSameUnderEveryValue) {
  const auto verdicts =
      JudgeAcross(Asking({"learning"}),
                  {Under("power", "0", Verdict::kBetter, 0.1), Under("power", "1", Verdict::kBetter, 0.1),
                   Under("two-rate", "0", Verdict::kBetter, 0.2), Under("two-rate", "1", Verdict::kWorse, -0.2)});
  ASSERT_EQ(verdicts.size(), 2u);  // one per noise
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
                                                           Under("two-rate", "0", Verdict::kInconclusive, 0.0),
                                                           Under("exponential", "0", Verdict::kBetter, 0.1)});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].verdict, Verdict::kInconclusive);
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
