#include "engine/fuzzy/fuzzy_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string PaperText() {
  for (const EmbeddedText& file : BuiltinFuzzySystemFiles()) {
    if (file.name == "paper.yaml") return std::string(file.text);
  }
  ADD_FAILURE() << "no paper.yaml";
  return "";
}

/// The paper's file with one text replaced, which must be there.
std::string With(const std::string& found, const std::string& replacement) {
  return testing::Replaced(PaperText(), found, replacement);
}

std::string Complaint(const std::string& text) {
  const auto system = ReadFuzzySystem(text, "f.yaml");
  return system ? "" : ToString(system.error());
}

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

struct Wrong {
  std::string found, replacement, complaint;
};

TEST(FuzzySystem, ComplainsWhereItIsWrongAndSaysWhatIsAllowed) {
  ASSERT_EQ(Complaint(PaperText()), "") << "the control";
  const Wrong wrongs[] = {
      {"{triangular: [20, 90, 180]}", "{triangular: [90, 20, 180]}", "f.yaml:12:30: 'triangular' needs rising numbers"},
      {"{triangular: [20, 90, 180]}", "{triangular: [20, 90]}", "needs [left, peak, right], found a list of 2"},
      {"{triangular: [20, 90, 180]}", "{triangular: [20, .nan, 180]}", "expected a number"},
      {"{triangular: [20, 90, 180]}", "{triangular: [20, 90, 1e300]}", "out of range"},
      {"{triangular: [20, 90, 180]}", "{gaussian: [90, 0]}", "sigma must be at least 0.001, found 0"},
      {"{triangular: [20, 90, 180]}", "{gaussian: [90, -25]}", "sigma must be at least 0.001, found -25"},
      {"{triangular: [20, 90, 180]}", "{gaussian: [900, 25]}", "no input of the universe [0, 180] has grade 1"},
      {"{triangular: [20, 90, 180]}", "{singleton: [90]}", "'singleton' needs a number"},
      {"{triangular: [20, 90, 180]}", "{triangle: [20, 90, 180]}", "did you mean 'triangular'?"},
      {"{triangular: [20, 90, 180]}", "90", "a term needs one shape"},
      {"      mid: {tri", "      middle: {tri", "'terms' of RH, LH"},
      {"      mid: {triangular: [20, 90, 180]}", "", "RH, LH needs all its terms: down, mid, up"},
      {"RH, LH:", "RH, LHA:", "unknown feature 'LHA'; did you mean 'LH'?"},
      {"RH, LH:", "RH:", "'features' lacks LH"},
      {"RH, LH:", "RH, LF:", "have different terms (down, mid, up; inward, outward)"},
      {"  RHE, LHE:", "  RHE, LHE, RHE:", ""},
      {"universe: [0, 180]", "universe: [180, 0]", "'universe' must be two rising numbers"},
      {"universe: [0, 180]", "", "'universe' must be two rising numbers"},
      {"weight: 1\n", "weight: -1\n", "-1 is out of range"},
      {"weight: 1\n", "\n", "needs a 'weight'"},
      {"system: paper", "system: ''", "needs 'system'"},
      {"system: paper", "system: a b", "is not a valid name"},
      {"system: paper", "sistem: paper", "is 'sistem' a misspelling of it?"},
      {"features:", "feature:", "needs 'features'"},
      {"{RH: up, LH: up, Posture: stand}", "{RH: uup}", "unknown term of RH 'uup'; did you mean 'up'?"},
      {"{RH: up, LH: up, Posture: stand}", "{RX: up}", "unknown feature 'RX'"},
      {"{RH: up, LH: up, Posture: stand}", "{}", "'if' must name terms"},
      {"then: arms up", "then: 'arms: up'", "is not a valid name of a pose"},
      {"then: arms up", "so: arms up", "needs 'then'"},
      {"then: arms up", "then: arms up and so on and on and on to letter 41 plus", "at most 40 letters"},
      {"terms:", "term:", "needs 'terms'"},
      {"rules:\n", "rules: none\nothers:\n", ""},
  };
  int checked = 0;
  for (const Wrong& wrong : wrongs) {
    const std::string complaint = Complaint(With(wrong.found, wrong.replacement));
    EXPECT_THAT(complaint, StartsWith("f.yaml:")) << wrong.replacement;
    EXPECT_THAT(complaint, HasSubstr(wrong.complaint)) << wrong.replacement;
    EXPECT_EQ(complaint.find('\n'), std::string::npos);
    ++checked;
  }
  EXPECT_EQ(checked, 32);
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
