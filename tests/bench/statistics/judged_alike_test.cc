#include "bench/statistics/judged_alike.h"

#include <gmock/gmock.h>

#include "bench/statistics/summary.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kError = "mpjpe_unaligned_mm";
constexpr const char* kRootError = "mpjpe_root_mm";
constexpr const char* kJitter = "jitter@wham";

/// A study of two methods on twelve clips, as task evaluation has it.
Study StudyOfFiles() {
  Study study;
  study.scenario = "evaluate";
  study.task = "evaluation";
  study.unit = SamplingUnit::kClip;
  study.trials = 12;
  study.methods = {{"a", "a"}, {"b", "a"}};
  study.conditions = {{}};
  study.metrics = {kError, kRootError, kJitter};
  study.success = "seen_share";
  study.success_matters = kMaxShareDifference;
  return study;
}

/// Summarises rows in which b is 10 mm better than a in each clip. `change(trial, result)` changes b's rows.
template <typename Change>
ConditionSummary SummaryWith(const Change& change) {
  const Study study = StudyOfFiles();
  ScenarioTable table(study);
  for (int trial = 0; trial < study.trials; ++trial) {
    for (const char* method : {"a", "b"}) {
      Row row{study.scenario, study.task, {}, trial, "", {"clip" + std::to_string(trial)}, method, {}};
      row.result = CellResult::Ended(Status::kOk, "");
      const bool is_b = row.method == "b";
      for (const std::string& metric : study.metrics) row.result.Measure(metric, (is_b ? 30 : 40) + 0.1 * trial);
      row.result.Measure("seen_share", 1);
      row.result.judged = {{"left_wrist", "right_wrist", "root pelvis"}, 60, {}};
      if (is_b) change(trial, row.result);
      table.Add(row);
    }
  }
  return Summarise(study, table, 1).conditions.front();
}

const Comparison& Of(const ConditionSummary& summary, const std::string& metric) {
  return *std::ranges::find(summary.comparisons, metric, &Comparison::metric);
}

TEST(JudgedAlike, MethodsThatWereAreCompared) {
  const ConditionSummary summary = SummaryWith([](int trial, CellResult& result) {
    result.judged.rate_hz = 59.94;
    if (trial == 3) result.judged.shares = {{kError, 0.95}};  // 0.4 % on average
  });
  for (const Comparison& comparison : summary.comparisons) {
    EXPECT_EQ(comparison.verdict, Verdict::kBetter) << comparison.why_open;
    EXPECT_EQ(comparison.beyond.verdict, Verdict::kBetter);
    EXPECT_THAT(comparison.not_alike, IsEmpty());
  }
  EXPECT_EQ(summary.answers.front().verdict, Verdict::kBetter);
}

TEST(JudgedAlike, NoMethodIsBetterByFewerJointsOrAnotherRoot) {
  const ConditionSummary summary = SummaryWith([](int, CellResult& result) {
    result.judged.parts = {"right_wrist", "root midway between the hips"};
  });
  for (const Comparison& comparison : summary.comparisons) {
    EXPECT_EQ(comparison.verdict, Verdict::kUndecided);
    EXPECT_EQ(comparison.beyond.verdict, Verdict::kUndecided);
    EXPECT_EQ(
        comparison.why_open,
        comparison.metric == kRootError
            ? "not judged alike: only “a” is judged on left_wrist, root pelvis; only “b” is judged on root midway "
              "between the hips"
            : "not judged alike: only “a” is judged on left_wrist");
    EXPECT_EQ(comparison.beyond.why_open, comparison.why_open);
  }
  EXPECT_EQ(summary.answers.front().verdict, Verdict::kUndecided);
  EXPECT_EQ(summary.answers.front().beyond, Verdict::kUndecided);
}

TEST(JudgedAlike, NoMethodIsBetterByLeavingOutFourPerCent) {
  // The two methods are equal in the frames that b shows; b leaves out its worst 4 %.
  const ConditionSummary summary = SummaryWith([](int, CellResult& result) {
    for (MetricValue& metric : result.metrics) {
      if (metric.id == "seen_share") metric.value = 0.96;
    }
    result.judged.shares = {{kError, 0.96}, {kRootError, 0.96}, {kJitter, 0.96}};
  });
  for (const Comparison& comparison : summary.comparisons) {
    EXPECT_EQ(comparison.verdict, Verdict::kUndecided);
    EXPECT_THAT(comparison.why_open, HasSubstr("“a” is judged on 100.0 % of what the truth shows, “b” on 96.0 %"));
  }
  const Answer& answer = summary.answers.front();
  EXPECT_EQ(answer.verdict, Verdict::kWorse);
  EXPECT_EQ(answer.decided_by, AnswerStep::kSuccess);
  EXPECT_EQ(answer.beyond, Verdict::kWorse);
}

TEST(JudgedAlike, EachMetricHasItsOwnShareAndMayDependOnTheRate) {
  const ConditionSummary summary = SummaryWith([](int, CellResult& result) {
    result.judged.shares = {{kRootError, 0.6}};  // the root is hidden in 40 % of the frames
    result.judged.rate_hz = 30;
  });
  EXPECT_EQ(Of(summary, kError).verdict, Verdict::kBetter);
  EXPECT_EQ(Of(summary, kRootError).verdict, Verdict::kUndecided);
  EXPECT_EQ(Of(summary, kJitter).verdict, Verdict::kUndecided);
  EXPECT_EQ(Of(summary, kJitter).why_open,
            "not judged alike: “a” has 60 Hz, “b” 30 Hz, and the value depends on the rate");
}

TEST(JudgedAlike, OtherPartsMatterOnlyToMetricsThatNeedThem) {
  const ConditionSummary summary =
      SummaryWith([](int, CellResult& result) { result.judged.parts.back() = "root midway between the hips"; });
  EXPECT_EQ(Of(summary, kError).verdict, Verdict::kBetter);
  EXPECT_EQ(Of(summary, kJitter).verdict, Verdict::kBetter);
  EXPECT_EQ(Of(summary, kRootError).verdict, Verdict::kUndecided);
  const std::vector<std::string> both = {"head", "left_wrist", "root pelvis"}, head = {"head", "root pelvis"};
  for (const char* id : {"rte@wham", "pfc@edge", "skating_ratio@gmd", "contact_f1"})
    EXPECT_EQ(WhyNotAlike(*FindMetric(id), {{{&both}, {&head}}}, "a", "b"), "") << id << " needs no wrist";
  for (const char* id : {kError, kRootError, kJitter, "bend_error_deg", "angle_rmse_deg", "npss", "floating_mm"})
    EXPECT_NE(WhyNotAlike(*FindMetric(id), {{{&both}, {&head}}}, "a", "b"), "") << id;
  const auto needs_root = [](const std::string& id) {
    const std::vector<std::string> one = {"root a"}, other = {"root b"};
    return WhyNotAlike(*FindMetric(id), {{{&one}, {&other}}}, "a", "b") != "";
  };
  for (const char* id : {"mpjpe_root_scaled_mm", "pck_150mm@mpi_inf_3dhp", "auc_150mm@mpi_inf_3dhp", "rte@wham",
                         "accel_error_mps2@wham", "pfc@edge"})
    EXPECT_TRUE(needs_root(id)) << id;
  for (const char* id : {"w_mpjpe_mm@wham", "accel_error_mps2", "bend_error_deg", "npss", "contact_f1"})
    EXPECT_FALSE(needs_root(id)) << id;
}

TEST(JudgedAlike, TheRateIsThatAtWhichAMetricIsMeasured) {
  // b has twice the rate of the truth and of a, so both are compared with the truth at 60 Hz.
  const std::vector<std::string> parts = {"head"};
  const std::vector<JudgedPair> worlds = {{{&parts, 60, 0}, {&parts, 120, 60}}};
  for (const char* id : {"accel_error_mps2", "accel_error_mm@human_dynamics", "accel_error_mps2@wham", "npss",
                         "npss@lafan1", "w_mpjpe_mm@wham", "wa_mpjpe_mm@wham", "rte@wham", kError})
    EXPECT_EQ(WhyNotAlike(*FindMetric(id), worlds, "a", "b"), "") << id;
  for (const char* id : {kJitter, "skating_ratio@gmd", "skate_from_height_mps@kimodo", "skate_from_contacts_mps@kimodo",
                         "pfc@edge", "beat_alignment@bailando", "beat_alignment@mint"}) {
    EXPECT_EQ(WhyNotAlike(*FindMetric(id), worlds, "a", "b"),
              "not judged alike: “a” has 60 Hz, “b” 120 Hz, and the value depends on the rate")
        << id;
  }
  // The control: b is compared at half the rate.
  EXPECT_NE(WhyNotAlike(*FindMetric("accel_error_mps2"), {{{&parts, 60, 0}, {&parts, 30, 0}}}, "a", "b"), "");
}

TEST(JudgedAlike, AnExpectationIsUndecidedAsWell) {
  Study study = StudyOfFiles();
  study.expectations = {{.metric = kError, .of = "b", .below = "a"}};
  const auto outcome = [&](double share) {
    ScenarioTable table(study);
    for (int trial = 0; trial < study.trials; ++trial) {
      for (const char* method : {"a", "b"}) {
        Row row{study.scenario, study.task, {}, trial, "", {"clip" + std::to_string(trial)}, method, {}};
        row.result = CellResult::Ended(Status::kOk, "");
        row.result.Measure(kError, (row.method == "b" ? 30 : 40) + 0.1 * trial);
        row.result.judged = {{"head"}, 60, {{kError, row.method == "b" ? share : 1}}};
        table.Add(row);
      }
    }
    return Summarise(study, table, 1).expectations.front();
  };
  EXPECT_EQ(outcome(1).outcome, ClaimOutcome::kMet);
  EXPECT_EQ(outcome(0.96).outcome, ClaimOutcome::kUndecided);
  EXPECT_THAT(outcome(0.96).detail, HasSubstr("not judged alike"));
}

}  // namespace
}  // namespace etude
