#include "bench/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using testing::HasSubstr;

const std::string kHead = "scenario: s\nquestion: q?\ntask: ik\n";
const std::string kMethods = "methods: [{name: a}, {name: b}]\n";

std::string Complaint(const std::string& yaml) {
  const auto scenario = ParseScenario(yaml, "s.yaml");
  return scenario ? "" : ToString(scenario.error());
}

TEST(Scenario, TakesTheProductOfItsSweepsLastFastest) {
  const auto scenario = ParseScenario(kHead + kMethods + "sweep: {x: [1, 2], y: [a, b]}\n", "s.yaml");
  ASSERT_TRUE(scenario) << ToString(scenario.error());
  ASSERT_EQ(scenario->conditions.size(), 4u);
  EXPECT_EQ(ConditionLabel(scenario->conditions[0].settings), "x=1, y=a");
  EXPECT_EQ(ConditionLabel(scenario->conditions[1].settings), "x=1, y=b");
  EXPECT_EQ(ConditionLabel(scenario->conditions[3].settings), "x=2, y=b");
  EXPECT_EQ(scenario->conditions[3].node.Find("x")->scalar, "2");
  EXPECT_EQ(ToString(scenario->conditions[3].node.Find("x")->place), "s.yaml:5:16");
}

TEST(Scenario, PutsASweptValueInPlaceOfTheWrittenOne) {
  const auto scenario = ParseScenario(kHead + kMethods + "x: 7\nsweep: {x: [1, 2]}\n", "s.yaml");
  ASSERT_TRUE(scenario);
  EXPECT_EQ(scenario->conditions[1].node.Find("x")->scalar, "2");
}

TEST(Scenario, ComparesEachMethodWithTheFirstOrTheOneItNames) {
  const auto scenario =
      ParseScenario(kHead + "methods: [{name: a}, {name: b}, {name: c, against: b, solver: ccd}]\n", "s.yaml");
  ASSERT_TRUE(scenario);
  EXPECT_EQ(scenario->baselines, (std::vector<std::string>{"a", "a", "b"}));
  EXPECT_EQ(scenario->methods[2].Find("against"), nullptr);
  EXPECT_EQ(scenario->methods[2].Find("solver")->scalar, "ccd");
  EXPECT_THAT(Complaint(kHead + "methods: [{name: a}, {name: b, against: d}]\n"),
              HasSubstr("s.yaml:4:41: unknown against 'd'"));
}

TEST(Scenario, TellsWhatIsWrongAndWhere) {
  EXPECT_THAT(Complaint("question: q?\ntask: ik\n" + kMethods), HasSubstr("a scenario needs 'scenario'"));
  EXPECT_THAT(Complaint("scenario: ../x\n" + kMethods), HasSubstr("s.yaml:1:11: '../x' is no scenario"));
  EXPECT_THAT(
      Complaint("scenario: s\nquestion: q?\ntask: ikk\n" + kMethods),
      HasSubstr("s.yaml:3:7: unknown task 'ikk'; did you mean 'ik'? Allowed: transition, detection, ik, capture"));
  EXPECT_THAT(Complaint(kHead), HasSubstr("a scenario needs 'methods'"));
  EXPECT_THAT(Complaint(kHead + "methods: [{solver: ccd}]\n"), HasSubstr("s.yaml:4:11: a method needs 'name'"));
  EXPECT_THAT(Complaint(kHead + "methods: [{name: a}, {name: a}]\n"), HasSubstr("two methods are named 'a'"));
  EXPECT_THAT(Complaint(kHead + kMethods + "trials: 0\n"), HasSubstr("s.yaml:5:9: 'trials': 0 is out of range"));
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {trials: [1]}\n"), HasSubstr("'trials' cannot be swept"));
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {x: []}\n"), HasSubstr("needs a list of values"));
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {x: [1, 1]}\n"),
              HasSubstr("s.yaml:5:16: the value '1' stands here twice"));
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {x: [a/b]}\n"), HasSubstr("found 'a/b'"));
  EXPECT_THAT(Complaint(kHead + kMethods + "metrics: [position_eror_cm]\n"),
              HasSubstr("s.yaml:5:11: unknown metric 'position_eror_cm'; did you mean 'position_error_cm'?"));
}

TEST(Scenario, TellsWhatIsWrongWithAnExpectation) {
  const auto complaint = [](const std::string& expectation) {
    return Complaint(kHead + kMethods + "expect:\n  - " + expectation + "\n");
  };
  EXPECT_EQ(complaint("{metric: position_error_cm, of: a, below: b}"), "");
  EXPECT_THAT(complaint("{metric: position_error_cm, of: c, below: b}"), HasSubstr("s.yaml:6:37: unknown of 'c'"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: a}"), HasSubstr("differ from itself"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a}"), HasSubstr("exactly one of: below, above"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: b, at_most: 1}"), HasSubstr("found 2"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, belw: b}"), HasSubstr("did you mean 'below'?"));
  EXPECT_THAT(complaint("{metric: position_error_cm, of: a, below: b, where: {x: 1}}"), HasSubstr("unknown condition"));
}

TEST(Scenario, RefusesFractionsWhereOnlyWholeNumbersMeanSomething) {
  EXPECT_THAT(Complaint(kHead + kMethods + "seed: 1.5\n"), HasSubstr("s.yaml:5:7: 'seed' must be a whole number"));
  EXPECT_THAT(Complaint(kHead + kMethods + "video: {trials: [0.5]}\n"), HasSubstr("must be whole numbers"));
}

TEST(Scenario, RefusesAHugeSweepBeforeItTakesMemory) {
  std::string values = "0";
  for (int i = 1; i < 5000; ++i) values += fmt::format(",{}", i);
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {x: [" + values + "]}\n"), HasSubstr("more than 1000 conditions"));
}

}  // namespace
}  // namespace etude
