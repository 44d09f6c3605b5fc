#include "bench/gate/self_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "sim/random/stream.h"
#include "tests/bench/gate/example.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Two methods whose errors are normal around 50 cm; b's is larger than a's by `gap` in every world.
RunUnderSeed NormalRuns(double gap) {
  return [=](std::uint64_t seed) -> Result<FinishedRun> {
    return ExampleRun([=](int trial, const std::string& method) {
      RandomStream world({.suite_seed = seed, .scenario = "self-test", .trial = trial}, "world");
      CellResult result = ExampleResult(trial, world.Normal(50, 5));
      RandomStream own({.suite_seed = seed, .scenario = "self-test", .trial = trial}, method);
      result.metrics[0].value = *result.metrics[0].value + own.Normal(method == "b" ? gap : 0, 0.1);
      return result;
    });
  };
}

TEST(SelfTest, FindsNoAlarmBetweenEqualSeedsAndEveryLargeChange) {
  ASSERT_OK(report, RunSelfTest(NormalRuns(1), 20));
  EXPECT_EQ(report->comparisons, 12);
  EXPECT_EQ(report->rerun_alarms.count, 0);
  EXPECT_EQ(report->rerun_alarms.of, 20);
  EXPECT_LE(report->false_alarms.count, 3);
  EXPECT_EQ(report->false_alarm_comparisons.of, 20 * 12);
  EXPECT_EQ(report->injected.back().found.count, 20);
  EXPECT_LT(report->injected.front().found.count, 20);
  ASSERT_EQ(report->real.size(), 1u);
  EXPECT_EQ(report->real[0].found.count, 20);
  EXPECT_EQ(report->tail_rerun_alarms.of, 20);
  EXPECT_EQ(report->tail_rerun_alarms.count, 0);
  std::map<std::string, int> tails;
  for (const PowerResult& tail : report->tails) {
    EXPECT_EQ(tail.found.of, 20);
    tails[tail.change] = tail.found.count;
  }
  EXPECT_EQ(tails.at("position_error_cm worse in 3 of 24 worlds by 40 × the difference that matters"), 0);
  EXPECT_EQ(tails.at("position_error_cm worse in 4 of 24 worlds by 40 × the difference that matters"), 20);
  EXPECT_EQ(tails.at("position_error_cm worse in 4 of 24 worlds by 18 × the difference that matters"), 0);
  EXPECT_EQ(tails.at("position_error_cm lost in 1 of 24 worlds"), 20);
  EXPECT_TRUE(report->Holds());
}

TEST(SelfTest, DoesNotFindARealChangeThatIsNone) { EXPECT_LE(RunSelfTest(NormalRuns(0), 20)->real[0].found.count, 2); }

TEST(SelfTest, ConvictsAGateWhoseRerunsDiffer) {
  int calls = 0;
  const auto report = RunSelfTest(
      [&](std::uint64_t seed) -> Result<FinishedRun> {
        const double drift = 1e-12 * ++calls;
        return ExampleRun([=](int trial, const std::string&) { return ExampleResult(trial, drift * (1 + seed)); });
      },
      3);
  EXPECT_EQ(report->rerun_alarms.count, 3);
  EXPECT_EQ(report->tail_rerun_alarms.count, 0);  // the difference is too small for a tail
  EXPECT_FALSE(report->Holds());
}

TEST(SelfTest, ConvictsAGateWhoseRerunsDifferMuchInFewWorlds) {
  int calls = 0;
  const auto report = RunSelfTest(
      [&](std::uint64_t) -> Result<FinishedRun> {
        const double drift = 100 * ++calls;
        return ExampleRun([=](int trial, const std::string&) { return ExampleResult(trial, trial < 4 ? drift : 0); });
      },
      3);
  EXPECT_EQ(report->tail_rerun_alarms.count, 3);
  EXPECT_FALSE(report->Holds());
}

TEST(SelfTest, ConvictsAGateThatAlarmsBetweenSeeds) {
  const auto report = RunSelfTest(
      [](std::uint64_t seed) -> Result<FinishedRun> {
        // The seeds are not exchangeable: the second seed of each pair is worse.
        return ExampleRun([=](int trial, const std::string&) { return ExampleResult(trial, seed % 2 == 0 ? 5 : 0); });
      },
      4);
  EXPECT_EQ(report->false_alarms.count, 4);
  EXPECT_FALSE(report->Holds());
}

TEST(SelfTest, SaysWhenAScenarioGivesItNothingToInjectInto) {
  const auto report = RunSelfTest(
      [](std::uint64_t) -> Result<FinishedRun> {
        return ExampleRun([](int trial, const std::string&) { return ExampleResult(trial); },
                          "gate: {metrics: [solved_practical]}\n");
      },
      1);
  EXPECT_THAT(ToString(report.error()), HasSubstr("needs a metric that has a direction and is aggregated by its "
                                                  "median"));
}

}  // namespace
}  // namespace etude
