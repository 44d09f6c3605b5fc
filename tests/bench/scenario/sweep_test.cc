#include "tests/bench/scenario/parse.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> Labels(const std::string& sweep) {
  std::vector<std::string> labels;
  for (const Condition& condition : ParseOne(kHead + kMethods + "sweep: " + sweep + "\n").conditions) {
    labels.push_back(ConditionLabel(condition.swept));
  }
  return labels;
}

TEST(Sweep, TakesTheProductLastFastest) {
  EXPECT_THAT(Labels("{max_sweeps: [1, 2], noise: [uniform, gaussian]}"),
              ElementsAre("max_sweeps=1, noise=uniform", "max_sweeps=1, noise=gaussian", "max_sweeps=2, noise=uniform",
                          "max_sweeps=2, noise=gaussian"));
}

TEST(Sweep, PutsAValueWhereItsKeyIsReadAndPointsAtIt) {
  const Scenario scenario = ParseOne(
      "defaults: {question: q, task: ik, methods: [{name: a}, {name: b}], max_sweeps: 7}\n"
      "scenarios:\n- scenario: s\n  sweep: {max_sweeps: [1, 2]}\n");
  ASSERT_EQ(scenario.conditions.size(), 2u);
  EXPECT_EQ(scenario.conditions[1].node.Find("max_sweeps")->scalar, "2");
  EXPECT_EQ(ToString(scenario.conditions[1].node.Find("max_sweeps")->place), "s.yaml:4:27");
}

TEST(Sweep, RefusesAParameterThatTheScenarioAlsoSets) {
  const std::string said = "s.yaml:5:1: 'max_sweeps' is also in sweep";
  for (const char* sweep : {"{max_sweeps: [1, 2]}", "{together: {max_sweeps: [1, 2], poses: [0.5, 1]}}",
                            "{together: [{max_sweeps: [1, 2], poses: [0.5, 1]}]}"}) {
    EXPECT_THAT(Complaint(kHead + kMethods + "max_sweeps: 7\nsweep: " + sweep + "\n"), HasSubstr(said));
    // The sweep may also come from an included file.
    const SourceTexts included = {{"d.yaml", std::string("defaults: {sweep: ") + sweep + "}\n"}};
    const std::string includes = kHead + kMethods + "max_sweeps: 7\ninclude: [d.yaml]\n";
    EXPECT_THAT(Complaint(includes, included), HasSubstr(said));
    EXPECT_EQ(Complaint(includes + "sweep: {}\n", included), "");
  }
}

TEST(Sweep, TakesRangesByStepAndByCount) {
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 5, to: 20, step: 5}}"),
              ElementsAre("joint_noise_deg=5", "joint_noise_deg=10", "joint_noise_deg=15", "joint_noise_deg=20"));
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 20, to: 0, step: -8}}"),
              ElementsAre("joint_noise_deg=20", "joint_noise_deg=12", "joint_noise_deg=4"));
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 0, to: 1, count: 5}}"),
              ElementsAre("joint_noise_deg=0", "joint_noise_deg=0.25", "joint_noise_deg=0.5", "joint_noise_deg=0.75",
                          "joint_noise_deg=1"));
  EXPECT_THAT(Labels("{max_sweeps: {from: 1, to: 100000, count: 6, scale: log}}"),
              ElementsAre("max_sweeps=1", "max_sweeps=10", "max_sweeps=100", "max_sweeps=1000", "max_sweeps=10000",
                          "max_sweeps=100000"));
}

TEST(Sweep, WritesTheValuesOfARangeAsAPersonWould) {
  // In doubles, 0.1 + 2 × 0.1 is 0.30000000000000004, so 3 steps of 0.1 end just beyond 0.3.
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 0, to: 0.3, step: 0.1}}"),
              ElementsAre("joint_noise_deg=0", "joint_noise_deg=0.1", "joint_noise_deg=0.2", "joint_noise_deg=0.3"));
  // In doubles, 0.3 − 3 × 0.1 is −5.55e-17.
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 0.3, to: -0.1, step: -0.1}}"),
              ElementsAre("joint_noise_deg=0.3", "joint_noise_deg=0.2", "joint_noise_deg=0.1", "joint_noise_deg=0",
                          "joint_noise_deg=-0.1"));
  EXPECT_THAT(Labels("{joint_noise_deg: {from: -1000, to: -999.8, step: 0.1}}"),
              ElementsAre("joint_noise_deg=-1000", "joint_noise_deg=-999.9", "joint_noise_deg=-999.8"));
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 0, to: 1e-300, count: 3}}"),
              ElementsAre("joint_noise_deg=0", "joint_noise_deg=5e-301", "joint_noise_deg=1e-300"));
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 1, to: 10, count: 3, scale: log}}"),
              ElementsAre("joint_noise_deg=1", "joint_noise_deg=3.16227766017", "joint_noise_deg=10"));
}

TEST(Sweep, StepsThroughParametersTogether) {
  EXPECT_THAT(Labels("{together: {joint_noise_deg: [5, 15, 45], noise: [uniform, gaussian, uniform]}}"),
              ElementsAre("joint_noise_deg=5, noise=uniform", "joint_noise_deg=15, noise=gaussian",
                          "joint_noise_deg=45, noise=uniform"));
  EXPECT_THAT(
      Labels("{together: {joint_noise_deg: [5, 15], poses: {from: 0.5, to: 1, step: 0.5}}, max_sweeps: [1, 2]}"),
      ElementsAre("joint_noise_deg=5, poses=0.5, max_sweeps=1", "joint_noise_deg=5, poses=0.5, max_sweeps=2",
                  "joint_noise_deg=15, poses=1, max_sweeps=1", "joint_noise_deg=15, poses=1, max_sweeps=2"));
  EXPECT_EQ(Labels("{together: [{joint_noise_deg: [5, 15], noise: [uniform, gaussian]}, "
                   "{max_sweeps: [1, 2, 3], stop_at: [tight, tight, practical]}]}")
                .size(),
            6u);
}

TEST(Sweep, AllowsAValueToReturnWhereItsPartnerHasChanged) {
  EXPECT_EQ(Labels("{together: {poses: [1, 1], max_sweeps: [1, 2]}}").size(), 2u);
}

TEST(Sweep, RefusesAHugeSweepBeforeItTakesMemory) {
  std::string values = "0";
  for (int i = 1; i < 5000; ++i) values += fmt::format(",{}", i);
  EXPECT_THAT(Complaint(kHead + kMethods + "sweep: {max_sweeps: [" + values + "]}\n"),
              HasSubstr("more than 1000 values"));
  // Each condition copies the scenario's mapping, so the total of values is limited.
  EXPECT_THAT(
      Complaint(kHead + kMethods + "clips: [" + values + "]\nsweep: {poses: {from: 0, to: 0.9, step: 0.001}}\n"),
      HasSubstr("at most 300000 values in all"));
}

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
