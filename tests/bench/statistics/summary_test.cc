#include "bench/statistics/summary.h"

#include <gtest/gtest.h>

#include "bench/scenario/scenario.h"
#include "bench/scenario/study_of.h"
#include "bench/statistics/judging.h"
#include "tests/bench/scenario/parse.h"

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

/// Method b is 2 cm better than a in every world; b has no value in trial 9.
std::vector<Row> Rows(const Study& study) {
  std::vector<Row> rows;
  for (const std::vector<SweptValue>& condition : study.conditions) {
    for (int trial = 0; trial < 10; ++trial) {
      for (const char* method : {"a", "b"}) {
        Row row{"s", "ik", condition, trial, "", {}, method, {}};
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

ScenarioTable Tabulate(const Study& study, std::span<const Row> rows) {
  ScenarioTable table(study);
  for (const Row& row : rows) table.Add(row);
  return table;
}

class SummaryTest : public ::testing::Test {
 protected:
  Study study = StudyOf(ParseOne(kYaml));
  std::vector<Row> rows = Rows(study);
  ScenarioSummary summary = Summarise(study, Tabulate(study, rows), 1);
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
  EXPECT_EQ(b.ok, 9);
  EXPECT_EQ(b.attempted, 10);
  EXPECT_NEAR(*b.ok_low, 0.596, 1e-3);  // Wilson's interval for 9 of 10
  EXPECT_NEAR(*b.ok_high, 0.982, 1e-3);
}

TEST_F(SummaryTest, GivesAShareItsOwnInterval) {
  // Ten of ten does not prove 100 %.
  const MetricSummary& solved = summary.conditions[0].methods[0].metrics[1];
  EXPECT_EQ(solved.id, "solved_practical");
  EXPECT_EQ(solved.interval, IntervalKind::kWilson);
  EXPECT_EQ(*solved.ci_low, 0);
  EXPECT_GT(*solved.ci_high, 0.2);
  EXPECT_EQ(summary.conditions[0].comparisons[1].interval, IntervalKind::kAdjustedWald);
}

TEST(Summary, AnAmountThatIsAlwaysZeroIsNoShare) {
  Study study = StudyOf(ParseOne(R"(
scenario: s
question: which?
task: evaluation
truth: [t]
methods: [{name: a, answers: [a]}]
metrics: ["l2p@lafan1", "skating_ratio@gmd"]
)"));
  study.trials = 10;
  study.unit = SamplingUnit::kWorld;
  ScenarioTable table(study);
  for (int trial = 0; trial < 10; ++trial) {
    Row row{"s", "evaluation", {}, trial, "", {}, "a", {}};
    row.result.status = Status::kOk;
    row.result.Measure("l2p@lafan1", 0);
    row.result.Measure("skating_ratio@gmd", 0);
    table.Add(row);
  }
  const ScenarioSummary summary = Summarise(study, table, 1);
  const auto interval_of = [&](const char* id) {
    const auto& metrics = summary.conditions[0].methods[0].metrics;
    return *std::ranges::find(metrics, id, &MetricSummary::id);
  };
  EXPECT_NE(interval_of("l2p@lafan1").interval, IntervalKind::kWilson);
  EXPECT_EQ(*interval_of("l2p@lafan1").ci_high, 0);
  EXPECT_EQ(interval_of("skating_ratio@gmd").interval, IntervalKind::kWilson);
}

TEST(WeightedSummary, IsTheMeanOverAllThatTheCellsHold) {
  const Study study = StudyOf(ParseOne(R"(
scenario: s
question: which?
task: evaluation
truth: [t]
methods: [{name: a, answers: [a]}, {name: b, answers: [b]}]
metrics: [npss]
)"));
  // Ten pairs; one has as much weight as the others together.
  Study ten = study;
  ten.trials = 10;
  ten.unit = SamplingUnit::kWorld;
  ScenarioTable table(ten);
  for (int trial = 0; trial < 10; ++trial) {
    for (const char* method : {"a", "b"}) {
      Row row{"s", "evaluation", {}, trial, "", {}, method, {}};
      row.result.status = Status::kOk;
      row.result.Measure("npss", (trial == 3 ? 1.0 : 0.1) + (method[0] == 'b' ? 0.01 * trial : 0));
      row.result.Measure("npss_power", trial == 3 ? 9 : 1);
      table.Add(row);
    }
  }
  const ScenarioSummary summary = Summarise(ten, table, 1);
  const auto& methods = summary.conditions[0].methods;
  const auto npss = std::ranges::find(methods[0].metrics, "npss", &MetricSummary::id);
  ASSERT_NE(npss, methods[0].metrics.end());
  EXPECT_NEAR(*npss->mean, (9 * 1.0 + 9 * 0.1) / 18, 1e-12);
  EXPECT_GT(*npss->ci_high, 0.6) << "one pair decides";
  // The difference of weighted means equals the weighted mean of differences.
  const Comparison& comparison = summary.conditions[0].comparisons[0];
  EXPECT_NEAR(*comparison.difference, 0.01 * (9 * 3 + 45 - 3) / 18, 1e-8);
}

TEST_F(SummaryTest, CorrectsOverAllConditionsAndMetrics) {
  EXPECT_EQ(summary.family, 4);
  const Comparison& comparison = summary.conditions[0].comparisons[0];
  EXPECT_DOUBLE_EQ(*comparison.signed_rank.p, 2.0 / 512);
  // Nine wins; the crash counts as a loss: 2 (1 + 10) / 2¹⁰ for ten equal differences.
  EXPECT_DOUBLE_EQ(*comparison.p_holm, 4 * 22.0 / 1024);
}

TEST_F(SummaryTest, CountsTheWorldsWithoutAPairAndSaysSo) {
  const Comparison& comparison = summary.conditions[0].comparisons[0];
  EXPECT_EQ(comparison.only_baseline, 1);
  EXPECT_EQ(comparison.only_method, 0);
  EXPECT_EQ(comparison.neither, 0);
  EXPECT_THAT(comparison.notes, ::testing::Contains(::testing::HasSubstr("only “a” has a value in 1")));
  // A world that both methods skipped is a loss of neither.
  for (Row& row : rows) {
    if (row.trial == 9) row.result = CellResult::Ended(Status::kSkipped, "no labels");
  }
  const ScenarioSummary skipped = Summarise(study, Tabulate(study, rows), 1);
  EXPECT_EQ(skipped.conditions[0].comparisons[0].only_baseline, 0);
  EXPECT_EQ(skipped.conditions[0].comparisons[0].neither, 0);
  EXPECT_TRUE(skipped.conditions[0].comparisons[0].notes.empty());
  EXPECT_EQ(skipped.conditions[0].methods[1].attempted, 9);
}

TEST_F(SummaryTest, DependsOnNoOtherMethodNorCondition) {
  Study smaller = study;
  smaller.conditions.pop_back();
  const ScenarioSummary alone = Summarise(smaller, Tabulate(smaller, std::span(rows).first(20)), 1);
  const Comparison &a = alone.conditions[0].comparisons[0], &b = summary.conditions[0].comparisons[0];
  EXPECT_EQ(a.ci_low, b.ci_low);
  EXPECT_EQ(a.sign_flip.p, b.sign_flip.p);
  EXPECT_NE(a.p_holm, b.p_holm);  // Holm's correction depends on the other comparisons
}

TEST_F(SummaryTest, PairsByWorldAgainstTheFirstMethod) {
  const Comparison& comparison = summary.conditions[0].comparisons[0];
  EXPECT_EQ(comparison.metric, "position_error_cm");
  EXPECT_EQ(comparison.baseline, "a");
  EXPECT_EQ(comparison.pairs, 9);
  EXPECT_DOUBLE_EQ(*comparison.difference, -2);
  EXPECT_DOUBLE_EQ(comparison.share_better, 1);
  EXPECT_EQ(comparison.verdict, Verdict::kUndecided);
  EXPECT_EQ(comparison.why_open,
            "“better” in worlds in which both have a value, but not if a failure counts as a loss");
  for (Row& row : rows) {
    if (row.trial == 9) row.result = CellResult::Ended(Status::kSkipped, "no labels");
  }
  EXPECT_EQ(Summarise(study, Tabulate(study, rows), 1).conditions[0].comparisons[0].verdict, Verdict::kBetter);
}

TEST_F(SummaryTest, JudgesExpectations) {
  ASSERT_EQ(summary.expectations.size(), 5u);
  EXPECT_EQ(summary.expectations[0].outcome, ClaimOutcome::kMet) << summary.expectations[0].detail;
  EXPECT_EQ(summary.expectations[1].outcome, ClaimOutcome::kUnmet) << summary.expectations[1].detail;
  EXPECT_EQ(summary.expectations[2].outcome, ClaimOutcome::kMet) << summary.expectations[2].detail;
  EXPECT_EQ(summary.expectations[3].outcome, ClaimOutcome::kUnmet) << summary.expectations[3].detail;
  EXPECT_EQ(summary.expectations[4].outcome, ClaimOutcome::kUndecided) << summary.expectations[4].detail;
}

TEST_F(SummaryTest, TakesAFailureForALossAndAMetricThatDoesNotApplyForNone) {
  const auto verdict_when_b_ends = [&](Status status) {
    std::vector<Row> fewer = rows;
    for (Row& row : fewer) {
      if (row.method != "b" || row.trial < 6) continue;
      row.result = CellResult::Ended(status, "why");
      row.result.Missing("position_error_cm", "why");
    }
    Study alone = study;
    alone.conditions.pop_back();
    alone.metrics = {"position_error_cm"};
    const ScenarioSummary judged = Summarise(alone, Tabulate(alone, std::span(fewer).first(20)), 1);
    return std::pair(judged.conditions[0].comparisons[0].verdict, judged.expectations[0].outcome);
  };
  EXPECT_EQ(verdict_when_b_ends(Status::kFailed), std::pair(Verdict::kUndecided, ClaimOutcome::kUndecided));
  EXPECT_EQ(verdict_when_b_ends(Status::kOk), std::pair(Verdict::kBetter, ClaimOutcome::kMet));
}

TEST_F(SummaryTest, AnExpectationIsHeldToItsConfidence) {
  Expectation below = study.expectations[0];
  below.confidence = 0.999;  // nine pairs reach p = 0.0039 at best
  const ExpectationResult result = JudgeExpectation(below, study, Tabulate(study, rows), 1);
  EXPECT_EQ(result.outcome, ClaimOutcome::kUndecided);
  EXPECT_THAT(result.detail, ::testing::HasSubstr("9 of these worlds differ, and a confidence of 99.9 % needs at "
                                                          "least 11 that differ"));
  EXPECT_THAT(result.detail, ::testing::HasSubstr("on 9 worlds, in 1 more a method has no value"));
}

/// Method b has the values of method a, but no value in the last `lost` of the 30 worlds, where a is worse.
TEST_F(SummaryTest, AnExpectationIsOpenIfOneOfTwoEqualMethodsLosesValues) {
  study.conditions.pop_back();
  study.trials = 30;
  const auto expectation_when = [&](int lost, Status status) {
    std::vector<Row> equal;
    for (int trial = 0; trial < 30; ++trial) {
      for (const char* method : {"a", "b"}) {
        Row row{"s", "ik", study.conditions[0], trial, "", {}, method, {}};
        row.result.status = Status::kOk;
        if (method[0] == 'b' && trial >= 30 - lost) {
          row.result.status = status;
          row.result.Missing("position_error_cm", "left out");
        } else {
          row.result.Measure("position_error_cm", trial < 20 ? 5 + 1e-6 * (method[0] == 'b' ? trial - 10 : 0) : 50);
        }
        equal.push_back(std::move(row));
      }
    }
    return JudgeExpectation(study.expectations[0], study, Tabulate(study, equal), 1);
  };
  EXPECT_EQ(expectation_when(0, Status::kOk).outcome, ClaimOutcome::kUnmet) << "the control: no value is lost";
  EXPECT_EQ(expectation_when(2, Status::kOk).outcome, ClaimOutcome::kUnmet) << "the control: two may be chance";
  const ExpectationResult open = expectation_when(10, Status::kOk);
  EXPECT_EQ(open.outcome, ClaimOutcome::kUndecided);
  EXPECT_THAT(open.detail, ::testing::HasSubstr("only “a” has a value in 10 worlds, and only “b” in 0"));
  EXPECT_NE(expectation_when(10, Status::kFailed).outcome, ClaimOutcome::kMet);
}

TEST_F(SummaryTest, AMissingValueNeverMeetsABound) {
  Expectation bound{.metric = "position_error_cm", .of = "b", .at_most = 100};
  EXPECT_EQ(JudgeExpectation(bound, study, Tabulate(study, rows), 1).outcome, ClaimOutcome::kUndecided);
}

TEST(SummaryOfNames, RenamedMethodsKeepEveryIntervalAndP) {
  constexpr const char* kPair = R"(
scenario: s
question: which?
task: ik
trials: 30
methods: [{name: NAME}, {name: other}]
metrics: [position_error_cm]
expect: [{metric: position_error_cm, of: other, below: NAME}]
)";
  // Returns the summary of the same values under another name of the first method.
  const auto summarise = [&](const std::string& name) {
    std::string yaml = kPair;
    for (std::size_t at; (at = yaml.find("NAME")) != std::string::npos;) yaml.replace(at, 4, name);
    const Study study = StudyOf(ParseOne(yaml));
    std::vector<Row> rows;
    for (int trial = 0; trial < 30; ++trial) {
      for (const std::string& method : {name, std::string("other")}) {
        Row row{"s", "ik", study.conditions.front(), trial, "", {}, method, {}};
        row.result.status = Status::kOk;
        const double spread = 0.1 * ((trial * trial * 7) % 31);
        row.result.Measure("position_error_cm", method == "other" ? 5 + 0.03 * ((trial * 11) % 29) : 5 + spread);
        rows.push_back(std::move(row));
      }
    }
    ScenarioTable table = Tabulate(study, rows);
    return Summarise(study, table, 1);
  };
  const ScenarioSummary a = summarise("a"), b = summarise("another-name");
  const MetricSummary &of_a = a.conditions[0].methods[0].metrics[0], &of_b = b.conditions[0].methods[0].metrics[0];
  ASSERT_TRUE(of_a.ci_low && of_a.ci_high);
  EXPECT_EQ(of_a.ci_low, of_b.ci_low);
  EXPECT_EQ(of_a.ci_high, of_b.ci_high);
  const Comparison &x = a.conditions[0].comparisons[0], &y = b.conditions[0].comparisons[0];
  ASSERT_EQ(x.sign_flip.how, "9,999 draws") << "the test must draw random numbers";
  EXPECT_EQ(x.sign_flip.p, y.sign_flip.p);
  EXPECT_EQ(x.ci_low, y.ci_low);
  EXPECT_EQ(x.ci_high, y.ci_high);
}

}  // namespace
}  // namespace etude
