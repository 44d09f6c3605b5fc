#include "bench/run/costs.h"

#include <gtest/gtest.h>

#include "bench/run/run.h"
#include "tests/bench/run/prepared.h"
#include "tests/support/replaced.h"

namespace etude {
namespace {

std::string WorkOfText(std::string text, const std::string& from = "", const std::string& to = "") {
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return WorkOf(ParseScenarios("small.yaml", {{"small.yaml", text}}).value().front());
}

TEST(WorkOfAScenario, IsWhatItsWorldsAndMethodsAreMadeOf) {
  const std::string work = WorkOfText(kSmallScenario);
  EXPECT_EQ(WorkOfText(kSmallScenario, "Does it run?", "Why?"), work);
  EXPECT_EQ(WorkOfText(kSmallScenario, "trials: 3", "trials: 9"), work);
  EXPECT_EQ(WorkOfText(kSmallScenario, "name: fixed", "name: other"), work);
  EXPECT_NE(WorkOfText(kSmallScenario, "max_sweeps: 20", "max_sweeps: 21"), work);
  EXPECT_NE(WorkOfText(kSmallScenario, "[2, 5]", "[2, 5, 9]"), work);
  EXPECT_NE(WorkOfText(kSmallScenario, "weights: fixed", "weights: adaptive"), work);
}

TEST(Pace, IsThatOfAllWorkersTogether) {
  const Result<Pace> pace = MeasurePace(2);
  ASSERT_TRUE(pace);
  EXPECT_GT(pace->yardsticks_per_s, 0);
  EXPECT_GT(pace->yardstick_ms, 0);
  // Two processes use at most two seconds of processor time per second of wall-clock time.
  EXPECT_LE(pace->yardsticks_per_s * pace->yardstick_ms, 2 * 1000 * 1.5);
}

TEST(ExpectedWork, TakesStoredCostsAndTheirMeanForOtherScenarios) {
  SuiteSetup suite = SmallSuite();
  suite.sources["b.yaml"] =
      testing::Replaced(testing::Replaced(kSmallScenario, "scenario: small", "scenario: b"), "sweeps: 20", "sweeps: 9");
  suite.scenarios.push_back(suite.scenarios.front());
  suite.scenarios.back().file = "b.yaml";
  suite.scenarios.back().name = "b";
  const auto prepared = Prepared(suite);
  const Plan plan(prepared);
  const std::size_t last = plan.world_count() - 1;
  const ExpectedWork unknown(plan, {});
  EXPECT_EQ(unknown.OfWorld(0), 1);
  EXPECT_EQ(unknown.SecondsEach(2), 0);
  // The cost of the first scenario is spread over its cells. The second scenario's cost is unknown, so its cells are
  // expected to cost as much as those of the first.
  std::map<std::string, KeptCost> kept;
  kept[WorkOf(prepared[0].scenario())] = {.once = 42, .trial = 6};
  const ExpectedWork known(plan, kept);
  EXPECT_DOUBLE_EQ(known.OfWorld(0), 5);  // (42 + 3 trials × 6) / 12 cells
  EXPECT_DOUBLE_EQ(known.Of(plan.CellAt(last, 0)), 5);
  EXPECT_DOUBLE_EQ(known.SecondsEach(2), 0.00025);
}

TEST(Progress, EstimatesByTheMeasuredPaceAndFirstByTheExpectedOne) {
  // Without stored costs: 10 of 100 cells took 5 s, so the others take 45 s.
  EXPECT_DOUBLE_EQ((Progress{.work = 100, .work_done = 10, .seconds = 5}.SecondsToGo()), 45);
  EXPECT_EQ((Progress{.work = 100, .seconds = 5}.SecondsToGo()), 0);
  // In a run of 60 s the expensive cells come first: after 6 s, 1 % of the cells and 10 % of the work are done. An
  // estimate by the number of cells would be 594 s.
  Progress known{.work = 60, .seconds_per_work = 1};
  EXPECT_DOUBLE_EQ(known.SecondsToGo(), 60);
  known.work_done = known.seconds = 6;
  EXPECT_DOUBLE_EQ(known.SecondsToGo(), 54);
  // On a machine that is half as fast as expected, the estimate approaches the truth.
  known.work_done = 54;
  known.seconds = 108;
  EXPECT_DOUBLE_EQ(known.SecondsToGo(), 11.4);  // 12 s are the truth
  // A resumed run measures its own work alone.
  EXPECT_DOUBLE_EQ((Progress{.work = 100, .work_done = 60, .work_before = 50, .seconds = 5}.SecondsToGo()), 20);
}

}  // namespace
}  // namespace etude
