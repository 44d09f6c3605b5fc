#include "bench/finished_runs/finished_runs.h"

#include <gtest/gtest.h>

#include "bench/gate/self_test.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TEST(Rehearsal, RunsItsBuiltInScenarioTheSameWayTwice) {
  ASSERT_OK(rehearsal, ReadRehearsal("", 4));
  ASSERT_OK(report, RunSelfTest([&](std::uint64_t seed) { return RunInProcess(*rehearsal, seed); }, 2));
  EXPECT_EQ(report->rerun_alarms.count, 0);
  EXPECT_EQ(report->rerun_alarms.of, 2);
  EXPECT_FALSE(ReadRehearsal("no-such-file.yaml", {}));
}

}  // namespace
}  // namespace etude
