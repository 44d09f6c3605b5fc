#include "engine/fuzzy/fuzzy_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/kept_answers.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::string PaperText() {
  for (const EmbeddedText& file : BuiltinFuzzySystemFiles()) {
    if (file.name == "paper.yaml") return std::string(file.text);
  }
  ADD_FAILURE() << "no paper.yaml";
  return "";
}

std::string Complaint(const std::string& text) { return testing::Refusal(ReadFuzzySystem(text, "f.yaml")); }

std::string Written(const FuzzySystem& system) { return WriteFuzzySystem(system); }

TEST(FuzzySystem, ShipsThePapersAndAnother) {
  for (const std::string& name : BuiltinFuzzySystemNames()) {
    ASSERT_OK(system, LoadBuiltinFuzzySystem(name, {}));
    EXPECT_EQ(system->name, name);
  }
  EXPECT_THAT(BuiltinFuzzySystemNames(), ::testing::ElementsAre("gaussian", "paper"));
  EXPECT_EQ(Written(*LoadBuiltinFuzzySystem("paper", {})), Written(FuzzySystem{}));
  EXPECT_NE(Written(*LoadBuiltinFuzzySystem("gaussian", {})), Written(FuzzySystem{}));
  EXPECT_THAT(ToString(LoadBuiltinFuzzySystem("papr", {"s.yaml", 3, 8}).error()),
              HasSubstr("s.yaml:3:8: unknown fuzzy system 'papr'; did you mean 'paper'?"));
}

TEST(FuzzySystem, WeighsAsThePaperDoes) {
  const FuzzySystem paper;
  double sum = 0;
  for (double weight : paper.weights) sum += weight;
  EXPECT_EQ(sum, kWeightSum);
  EXPECT_EQ(paper.weights[static_cast<std::size_t>(Feature::kTrunk)], 1);
  EXPECT_EQ(paper.weights[static_cast<std::size_t>(Feature::kLFK)], 0.5);
}

TEST(FuzzySystem, IsReadBackAsWritten) {
  FuzzySystem tuned;
  tuned.name = "tuned";
  tuned.weights = {1.1, 0.9, 1, 1, 1, 1, 1.0 / 3, 2.0 / 3, 0.25, 0.75};
  tuned.memberships.shapes[0] = Gaussian{1.0 / 3, 0.1 + 0.2};
  tuned.memberships.shapes[1] = Singleton{91.5};
  const std::string text = Written(tuned);
  const auto read = ReadFuzzySystem(text, "f.yaml");
  ASSERT_TRUE(read) << ToString(read.error()) << "\n" << text;
  EXPECT_EQ(read->weights, tuned.weights);
  EXPECT_EQ(std::get<Gaussian>(read->memberships.shapes[0]).sigma, 0.1 + 0.2);
  EXPECT_EQ(Written(*read), text);
  EXPECT_EQ(read->rules.poses, tuned.rules.poses);
  EXPECT_EQ(read->rules.rules.size(), tuned.rules.rules.size());
}

TEST(FuzzySystem, ScalesWeightsToSumToEight) {
  std::string text = PaperText();
  for (const auto& [from, to] : {std::pair{"weight: 1\n", "weight: 4\n"}, std::pair{"weight: 0.5", "weight: 2"}}) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, std::string(from).size(), to);
  }
  ASSERT_OK(system, ReadFuzzySystem(text, "f.yaml"));
  for (std::size_t k = 0; k < kFeatureCount; ++k) EXPECT_DOUBLE_EQ(system->weights[k], PaperWeights()[k]);
}

// Edits of the paper's file; limits are tested on both sides.
TEST(FuzzySystem, ComplainsWhereItIsWrongAndSaysWhatIsAllowed) {
  const std::string paper = PaperText();
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/fuzzy/complaints.txt", [&](const std::string& edit) {
    return Complaint(testing::Edited(paper, edit));
  }));
}

TEST(FuzzySystem, HasAtMostAHundredRules) {
  std::string rules = "rules:\n";
  for (std::size_t i = PaperRules().rules.size(); i < 100; ++i) rules += "  - {if: {RH: up}, then: more}\n";
  EXPECT_EQ(Complaint(testing::Replaced(PaperText(), "rules:\n", rules)), "accepted");
  rules += "  - {if: {RH: up}, then: more}\n";
  EXPECT_THAT(Complaint(testing::Replaced(PaperText(), "rules:\n", rules)), HasSubstr("'rules' must be a list of "));
}

TEST(FuzzySystem, RefusesWeightsThatAreAllZero) {
  std::string text = PaperText();
  for (const std::string from : {"weight: 1\n", "weight: 0.5"}) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), "weight: 0\n");
  }
  EXPECT_THAT(Complaint(text), HasSubstr("all weights are 0"));
}

}  // namespace
}  // namespace etude
