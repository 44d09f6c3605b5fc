#include "tests/bench/scenario/parse.h"

namespace etude {
namespace {

using ::testing::ElementsAre;

const std::string kOfLibraries = "scenario: s\nquestion: q\ntask: transition\nmethods: [{name: a}]\n";

std::vector<std::string> Labels(const Scenario& scenario) {
  std::vector<std::string> labels;
  for (const Condition& condition : scenario.conditions) labels.push_back(ConditionLabel(condition.swept));
  return labels;
}

TEST(Libraries, HaveEveryConditionOnceEach) {
  const Scenario scenario = ParseOne(kOfLibraries +
                                     "sweep: {threshold: [0.3, 0.4]}\n"
                                     "libraries: {moves: ['builtin:*'], mine: [a.bvh, b.bvh]}\n");
  EXPECT_THAT(Labels(scenario), ElementsAre("library=moves, threshold=0.3", "library=moves, threshold=0.4",
                                            "library=mine, threshold=0.3", "library=mine, threshold=0.4"));
  EXPECT_EQ(scenario.conditions[2].library, "mine");
  EXPECT_THAT(scenario.libraries[1].clips, ElementsAre("a.bvh", "b.bvh"));
}

TEST(Libraries, CanBeAddedOnceToThoseOfTheScenarioAndToNone) {
  const NamedClips extra[] = {{"mine", {"a.bvh"}}};
  Scenario with = ParseOne(kOfLibraries + "libraries: {moves: ['builtin:*']}\n");
  for (int again = 0; again < 2; ++again) AddLibraries(extra, with);
  EXPECT_THAT(Labels(with), ElementsAre("library=moves", "library=mine"));
  Scenario without = ParseOne(kOfLibraries + "clips: ['builtin:*']\nsweep: {threshold: [0.3, 0.4]}\n");
  AddLibraries(extra, without);
  EXPECT_THAT(Labels(without), ElementsAre("library=mine, threshold=0.3", "library=mine, threshold=0.4"));
}

}  // namespace
}  // namespace etude
