#include "bench/run/parallel_summary.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "bench/results/summary_json.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Many conditions of few worlds; some cells fail, so that comparisons also have an answer that counts failures.
Study ManyConditions() {
  Study study;
  study.scenario = "many";
  study.task = "ik";
  study.trials = 260;  // enough rows to be split among processes
  study.methods = {{"a", "a", false}, {"b", "a", false}};
  study.metrics = {"position_error_cm", "solved_practical"};
  for (int i = 0; i < 40; ++i) study.conditions.push_back({{"joint_noise_deg", std::to_string(i)}});
  return study;
}

ScenarioTable Filled(const Study& study) {
  ScenarioTable table(study);
  RandomStream dice({.suite_seed = 1, .scenario = "sum-up", .trial = 0}, "values");
  Row row{study.scenario, study.task, {}, 0, "", {}, "", {}};
  for (const auto& condition : study.conditions) {
    row.condition = condition;
    for (row.trial = 0; row.trial < study.trials; ++row.trial) {
      for (const ComparedMethod& method : study.methods) {
        row.method = method.name;
        const bool fails = method.name == "b" && dice.Chance(0.05);
        row.result = CellResult::Ended(fails ? Status::kFailed : Status::kOk, fails ? "it did" : "");
        row.result.MeasureOr("position_error_cm", fails ? std::nullopt : std::optional(dice.Uniform()), "it failed");
        row.result.Measure("solved_practical", dice.Chance(0.7) ? 1 : 0);
        table.Add(row);
      }
    }
  }
  return table;
}

TEST(SummariseInParallel, SaysTheSameForAnyNumberOfProcesses) {
  const Study study = ManyConditions();
  const ScenarioTable table = Filled(study);
  const std::string alone = *WriteJson(EncodeSummaries({Summarise(study, table, 1)}));
  EXPECT_THAT(alone, HasSubstr("only_baseline"));
  for (const int jobs : {1, 2, 3}) {
    std::size_t told = 0;
    const auto summary = SummariseInParallel(study, table, 1, jobs, [&](std::size_t done, std::size_t all) {
      EXPECT_EQ(all, 80u);
      EXPECT_GE(done, told);
      told = done;
    });
    EXPECT_EQ(told, 80u);
    ASSERT_TRUE(summary) << ToString(summary.error());
    EXPECT_EQ(*WriteJson(EncodeSummaries({*summary})), alone) << jobs;
  }
}

TEST(RunForked, GivesAnswersInOrderHoweverLong) {
  ASSERT_OK(answers, RunForked(7, 3, [](std::size_t i) -> Result<std::string> {
              return std::string(i * 100'000, static_cast<char>('a' + i));
            }));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ((*answers)[i], std::string(i * 100'000, static_cast<char>('a' + i)));
  EXPECT_TRUE(RunForked(0, 3, [](std::size_t) -> Result<std::string> { return Fail({}, "never asked"); })->empty());
}

TEST(RunForked, PassesOnAComplaintAndNoticesADeath) {
  EXPECT_THAT(testing::Refusal(RunForked(5, 2,
                                         [](std::size_t i) -> Result<std::string> {
                                           if (i == 3) return Fail({"x", 1, 0}, "the fourth is wrong");
                                           return "fine";
                                         })),
              HasSubstr("x:1: the fourth is wrong"));
  const auto death = RunForked(5, 2, [](std::size_t i) -> Result<std::string> {
    if (i == 2) ::_exit(0);
    return "fine";
  });
  EXPECT_FALSE(death) << "exit code 0 without its answers is none";
}

}  // namespace
}  // namespace etude
