#include "engine/recognition/learnt_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// A bag is right if measure 5 is small and measure 9 is not; other measures do not matter.
std::vector<LabelledBag> Planted() {
  std::vector<LabelledBag> bags;
  for (int i = 0; i < 400; ++i) {
    PerformanceMeasures measures{};
    for (std::size_t m = 0; m < kMeasureCount; ++m) {
      measures[m] = 0.5 + 0.5 * std::sin(1.7 * i * static_cast<double>(m + 1) + static_cast<double>(m * m));
    }
    bags.push_back({measures[5] <= 0.5 && measures[9] > 0.3, {measures}});
  }
  return bags;
}

double ShareTold(const BoostedTrees& model, const std::vector<LabelledBag>& bags) {
  int told = 0;
  for (const LabelledBag& bag : bags) told += (model.Probability(bag.performances[0]) > 0.5) == bag.is_right;
  return told / static_cast<double>(bags.size());
}

TEST(FitBoostedTrees, FindsWhatWasPlanted) {
  const auto bags = Planted();
  const BoostedTrees model = FitBoostedTrees(bags);
  EXPECT_GT(ShareTold(model, bags), 0.97);
  EXPECT_GT(ShareTold(FitBoostedTrees(bags, {.trees = 300, .takes_turns = true}), bags), 0.97) << "in turns, too";
  auto shuffled = bags;
  for (std::size_t i = 0; i < bags.size(); ++i) shuffled[i].is_right = bags[i * 7 % bags.size()].is_right;
  EXPECT_LT(ShareTold(FitBoostedTrees(shuffled, {.trees = 5}), bags), 0.8) << "control: nothing to learn";
}

TEST(FitBoostedTrees, AsksOnlyOnePerformanceOfARightBagToBeRight) {
  auto bags = Planted();
  std::vector<LabelledBag> pairs;
  for (std::size_t i = 0; i + 1 < bags.size(); i += 2) {
    const auto& a = bags[i];
    const auto& b = bags[i + 1];
    pairs.push_back({a.is_right || b.is_right, {a.performances[0], b.performances[0]}});
  }
  const BoostedTrees model = FitBoostedTrees(pairs);
  const auto likeliest = [&](const LabelledBag& bag) {
    return std::max(model.Probability(bag.performances[0]), model.Probability(bag.performances[1]));
  };
  int told = 0;
  for (const LabelledBag& pair : pairs) told += (likeliest(pair) > 0.5) == pair.is_right;
  EXPECT_GT(told, static_cast<int>(0.85 * static_cast<double>(pairs.size())));
}

TEST(FitBoostedTrees, RepeatsItselfAndKnowsNothingOfOneKindAlone) {
  const auto bags = Planted();
  const auto a = FitBoostedTrees(bags, {.trees = 3}), b = FitBoostedTrees(bags, {.trees = 3});
  for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(a.trees[t].leaves, b.trees[t].leaves);
  auto right = bags;
  for (LabelledBag& bag : right) bag.is_right = true;
  EXPECT_EQ(FitBoostedTrees(right).Probability(bags[0].performances[0]), 0.5);
}

TEST(DecisionTree, AnswersByItsQuestions) {
  DecisionTree tree{
      .measures = {0, 1, 2, 0, 0, 0, 0}, .limits = {1, 1, 1, 0, 0, 0, 0}, .leaves = {1, 2, 3, 4, 5, 6, 7, 8}};
  PerformanceMeasures measures{};
  EXPECT_EQ(tree.Value(measures), 1) << "yes, yes, yes";
  measures[1] = 2;
  EXPECT_EQ(tree.Value(measures), 3) << "yes, no, yes";
  measures[0] = 2;
  measures[2] = 2;
  EXPECT_EQ(tree.Value(measures), 8) << "no, no, no";
}

TEST(LearntModelFile, ReadsBackToTheLastBit) {
  const LearntModel model{.asked = FitBoostedTrees(Planted(), {.trees = 4}), .spotted = {.bias = 0.1, .trees = {}}};
  ASSERT_OK(read, ReadLearntModel(WriteLearntModel(model), "model.yaml"));
  ASSERT_EQ(read->asked.trees.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(read->asked.trees[t].measures, model.asked.trees[t].measures);
    EXPECT_EQ(read->asked.trees[t].limits, model.asked.trees[t].limits);
    EXPECT_EQ(read->asked.trees[t].leaves, model.asked.trees[t].leaves);
  }
  EXPECT_EQ(read->spotted.bias, 0.1);
}

TEST(LearntModelFile, SaysWhereItIsWrong) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/recognition/complaints.txt", [](const std::string& text) {
    return testing::Refusal(ReadLearntModel(text, "model.yaml"));
  }));
}

TEST(BuiltinLearntModel, IsThere) { EXPECT_FALSE(BuiltinLearntModel().asked.trees.empty()); }

}  // namespace
}  // namespace etude
