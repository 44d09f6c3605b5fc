#include "bench/statistics/summary.h"

#include <gtest/gtest.h>

#include "bench/statistics/expectations.h"

namespace etude {
namespace {

constexpr const char* kYaml = R"(
scenario: s
question: which?
task: ik
trials: 10
sweep: {joint_noise_deg: [5, 10]}
methods: [{name: a}, {name: b}]
metrics: [position_error_cm, solved_practical]
expect:
  - {metric: position_error_cm, of: b, below: a}
  - {metric: position_error_cm, of: b, above: a, where: {joint_noise_deg: 5}}
  - {metric: position_error_cm, of: a, statistic: p95, at_most: 20}
  - {metric: position_error_cm, of: a, at_most: 1}
  - {metric: hidden_angle_error_deg, of: a, at_most: 1}
)";

/// Method b is 2 cm better than a in every world; trial 9 of b has no value.
std::vector<Row> Rows(const Scenario& scenario) {
  std::vector<Row> rows;
  for (const Condition& condition : scenario.conditions) {
    for (int trial = 0; trial < 10; ++trial) {
      for (const char* method : {"a", "b"}) {
        Row row{"s", "ik", condition.settings, trial, "", method, {}};
        row.result.status = Status::kOk;
        if (method[0] == 'b' && trial == 9) {
          row.result = CellResult::Ended(Status::kCrashed, "its worker ended");
          row.result.Missing("position_error_cm", "crashed");
        } else {
          row.result.Measure("position_error_cm", 5 + trial - (method[0] == 'b' ? 2 : 0));
          row.result.Measure("solved_practical", method[0] == 'b' ? 1 : 0);
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

class SummaryTest : public testing::Test {
 protected:
  Scenario scenario = *ParseScenario(kYaml, "s.yaml");
  std::vector<Row> rows = Rows(scenario);
  ScenarioSummary summary = Summarise(scenario, rows, 1);
};

TEST_F(SummaryTest, KeepsFailuresInTheCount) {
  ASSERT_EQ(summary.conditions.size(), 2u);
  const MethodSummary& b = summary.conditions[1].methods[1];
  EXPECT_EQ(b.statuses, (std::vector<std::pair<Status, int>>{{Status::kOk, 9}, {Status::kCrashed, 1}}));
  EXPECT_EQ(b.metrics[0].id, "position_error_cm");
  EXPECT_EQ(b.metrics[0].present, 9);
  EXPECT_EQ(b.metrics[0].missing, 1);
  EXPECT_DOUBLE_EQ(*b.metrics[0].median, 7);
  EXPECT_DOUBLE_EQ(*b.metrics[0].mean, 7);
}

TEST_F(SummaryTest, PairsByWorldAgainstTheFirstMethod) {
  const Comparison& comparison = summary.conditions[0].comparisons[0];
  EXPECT_EQ(comparison.metric, "position_error_cm");
  EXPECT_EQ(comparison.baseline, "a");
  EXPECT_EQ(comparison.pairs, 9);
  EXPECT_DOUBLE_EQ(*comparison.difference, -2);
  EXPECT_DOUBLE_EQ(comparison.share_better, 1);
  EXPECT_EQ(comparison.verdict, Verdict::kBetter);
}

TEST_F(SummaryTest, JudgesExpectations) {
  ASSERT_EQ(summary.expectations.size(), 5u);
  EXPECT_EQ(summary.expectations[0].outcome, Outcome::kMet) << summary.expectations[0].detail;
  EXPECT_EQ(summary.expectations[1].outcome, Outcome::kUnmet) << summary.expectations[1].detail;
  EXPECT_EQ(summary.expectations[2].outcome, Outcome::kMet) << summary.expectations[2].detail;
  EXPECT_EQ(summary.expectations[3].outcome, Outcome::kUnmet) << summary.expectations[3].detail;
  EXPECT_EQ(summary.expectations[4].outcome, Outcome::kUndecided) << summary.expectations[4].detail;
}

TEST_F(SummaryTest, AMissingValueNeverMeetsABound) {
  Expectation bound;
  bound.metric = "position_error_cm";
  bound.of = "b";
  bound.at_most = 100;
  EXPECT_EQ(JudgeExpectation(bound, scenario, rows, 1).outcome, Outcome::kUndecided);
}

}  // namespace
}  // namespace etude
