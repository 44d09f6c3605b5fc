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

std::string SweepComplaint(const std::string& sweep) { return Complaint(kHead + kMethods + "sweep: " + sweep + "\n"); }

TEST(Sweep, TakesTheProductLastFastest) {
  EXPECT_THAT(Labels("{max_sweeps: [1, 2], noise: [uniform, gaussian]}"),
              ElementsAre("max_sweeps=1, noise=uniform", "max_sweeps=1, noise=gaussian", "max_sweeps=2, noise=uniform",
                          "max_sweeps=2, noise=gaussian"));
}

TEST(Sweep, PutsAValueWhereItsKeyIsReadAndPointsAtIt) {
  const Scenario scenario = ParseOne(kHead + kMethods + "max_sweeps: 7\nsweep: {max_sweeps: [1, 2]}\n");
  ASSERT_EQ(scenario.conditions.size(), 2u);
  EXPECT_EQ(scenario.conditions[1].node.Find("max_sweeps")->scalar, "2");
  EXPECT_EQ(ToString(scenario.conditions[1].node.Find("max_sweeps")->place), "s.yaml:6:25");
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
  // In doubles 0.1 + 2 × 0.1 is 0.30000000000000004, and 3 steps of 0.1 end just short of 0.3.
  EXPECT_THAT(Labels("{joint_noise_deg: {from: 0, to: 0.3, step: 0.1}}"),
              ElementsAre("joint_noise_deg=0", "joint_noise_deg=0.1", "joint_noise_deg=0.2", "joint_noise_deg=0.3"));
  // And 0.3 - 3 × 0.1 is -5.55e-17.
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

TEST(Sweep, TellsWhatIsWrongWithAList) {
  EXPECT_EQ(SweepComplaint("[1]"),
            "s.yaml:5:8: 'sweep' must map parameters to lists or ranges of values, found a list");
  EXPECT_THAT(SweepComplaint("{trials: [1]}"), HasSubstr("s.yaml:5:9: 'trials' cannot be swept"));
  EXPECT_THAT(SweepComplaint("{joint_nose_deg: [1]}"),
              HasSubstr("s.yaml:5:9: unknown parameter of task ik 'joint_nose_deg'; did you mean 'joint_noise_deg'?"));
  EXPECT_THAT(SweepComplaint("{poses: []}"), HasSubstr("s.yaml:5:16: 'poses' needs a list of values to sweep over"));
  EXPECT_THAT(SweepComplaint("{poses: 1}"), HasSubstr("or a range such as {from: 5, to: 20, step: 5}, found '1'"));
  EXPECT_THAT(SweepComplaint("{poses: [1, 1]}"), HasSubstr("s.yaml:5:20: the value '1' is listed twice"));
  EXPECT_THAT(SweepComplaint("{poses: [1, 1.0]}"), HasSubstr("s.yaml:5:20: the value '1.0' is listed twice"));
  EXPECT_THAT(SweepComplaint("{poses: [a/b]}"), HasSubstr("found 'a/b'"));
  EXPECT_THAT(SweepComplaint("{poses: [[1]]}"), HasSubstr("must be a number or a text, found a list"));
}

TEST(Sweep, TellsWhatIsWrongWithARange) {
  const auto complaint = [](const std::string& range) { return SweepComplaint("{poses: " + range + "}"); };
  EXPECT_THAT(complaint("{from: 1}"), HasSubstr("s.yaml:5:16: a range needs 'to'"));
  EXPECT_THAT(complaint("{from: a, to: 1, step: 1}"), HasSubstr("s.yaml:5:23: 'from': expected a number, found 'a'"));
  EXPECT_THAT(complaint("{from: 0, to: 1, stp: 1}"), HasSubstr("unknown key of a range 'stp'; did you mean 'step'?"));
  EXPECT_THAT(complaint("{from: 0, to: 1}"), HasSubstr("either 'step' or 'count', found neither"));
  EXPECT_THAT(complaint("{from: 0, to: 1, step: 1, count: 2}"), HasSubstr("either 'step' or 'count', found both"));
  EXPECT_THAT(complaint("{from: 0, to: 1, step: 0}"), HasSubstr("steps of 0 do not lead from 0 to 1"));
  EXPECT_THAT(complaint("{from: 0, to: 1, step: -1}"), HasSubstr("steps of -1 do not lead from 0 to 1"));
  EXPECT_THAT(complaint("{from: 0, to: 0, step: 0}"), HasSubstr("steps of 0 do not lead from 0 to 0"));
  EXPECT_THAT(complaint("{from: 0, to: 1, step: 1e-300}"), HasSubstr("more than 1000 values"));
  EXPECT_THAT(complaint("{from: -1e308, to: 1e308, step: 1}"), HasSubstr("too far apart"));
  EXPECT_THAT(complaint("{from: -1e308, to: 1e308, count: 4}"), HasSubstr("too far apart"));
  EXPECT_THAT(complaint("{from: 1e-308, to: 1e308, count: 4, scale: log}"), HasSubstr("too far apart"));
  EXPECT_THAT(complaint("{from: 0, to: 1, count: 1}"), HasSubstr("'count': 1 is out of range; allowed: 2 to 1000"));
  EXPECT_THAT(complaint("{from: 0, to: 1, count: 2000}"), HasSubstr("allowed: 2 to 1000"));
  EXPECT_THAT(complaint("{from: 0, to: 1, count: 5, scale: log}"), HasSubstr("'from' and 'to' above 0"));
  EXPECT_THAT(complaint("{from: 1, to: 2, step: 1, scale: log}"), HasSubstr("'scale: log' needs 'count'"));
  EXPECT_THAT(complaint("{from: 1, to: 1, count: 2}"), HasSubstr("the value '1' is listed twice"));
}

TEST(Sweep, TellsWhatIsWrongWithParametersSteppedTogether) {
  EXPECT_THAT(
      SweepComplaint("{together: {poses: [1, 0.5], max_sweeps: [1, 2, 3]}}"),
      HasSubstr(
          "s.yaml:5:49: 'poses' and 'max_sweeps' are stepped together; they need equally many values, found 2 and 3"));
  EXPECT_THAT(SweepComplaint("{together: {poses: [1]}}"), HasSubstr("s.yaml:5:19: 'together' needs at least two"));
  EXPECT_THAT(SweepComplaint("{together: [1, 2]}"), HasSubstr("found '1'"));
  EXPECT_THAT(SweepComplaint("{together: []}"), HasSubstr("'together' needs at least two"));
  EXPECT_THAT(SweepComplaint("{poses: [1], together: {poses: [1], max_sweeps: [2]}}"),
              HasSubstr("'poses' is swept twice"));
  EXPECT_THAT(SweepComplaint("{together: {poses: [1, 0.5, 1], max_sweeps: [1, 2, 1]}}"),
              HasSubstr("s.yaml:5:36: the values 'poses=1, max_sweeps=1' are listed twice"));
  EXPECT_THAT(SweepComplaint("{together: {poses: [1, 2], max_swaps: [1, 2]}}"), HasSubstr("did you mean 'max_sweeps'"));
}

TEST(Sweep, AllowsAValueToReturnWhereItsPartnerHasChanged) {
  EXPECT_EQ(Labels("{together: {poses: [1, 1], max_sweeps: [1, 2]}}").size(), 2u);
}

TEST(Sweep, RefusesAHugeSweepBeforeItTakesMemory) {
  std::string values = "0";
  for (int i = 1; i < 5000; ++i) values += fmt::format(",{}", i);
  EXPECT_THAT(SweepComplaint("{max_sweeps: [" + values + "]}"), HasSubstr("more than 1000 values"));
  const std::string many = "{from: 0, to: 0.99, step: 0.01}";
  EXPECT_THAT(SweepComplaint("{poses: " + many + ", joint_noise_deg: " + many + "}"),
              HasSubstr("more than 1000 conditions"));
  // Each condition is a copy of the scenario's mapping.
  EXPECT_THAT(
      Complaint(kHead + kMethods + "clips: [" + values + "]\nsweep: {poses: {from: 0, to: 0.9, step: 0.001}}\n"),
      HasSubstr("at most 300000 values in all"));
}

}  // namespace
}  // namespace etude
