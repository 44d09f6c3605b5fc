#include "bench/finished_runs/finished_runs.h"

#include <gtest/gtest.h>

#include "bench/gate/self_test.h"

namespace etude {
namespace {

TEST(Rehearsal, RunsItsBuiltInScenarioTheSameWayTwice) {
  const auto rehearsal = ReadRehearsal("", 4);
  ASSERT_TRUE(rehearsal) << ToString(rehearsal.error());
  const auto report = RunSelfTest([&](std::uint64_t seed) { return RunInProcess(*rehearsal, seed); }, 2);
  ASSERT_TRUE(report) << ToString(report.error());
  EXPECT_EQ(report->rerun_alarms.count, 0);
  EXPECT_EQ(report->rerun_alarms.of, 2);
  EXPECT_FALSE(ReadRehearsal("no-such-file.yaml", {}));
}

}  // namespace
}  // namespace etude
