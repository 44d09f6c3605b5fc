#include "bench/run/costs.h"

#include <gtest/gtest.h>

#include "tests/bench/run/prepared.h"

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

}  // namespace
}  // namespace etude
