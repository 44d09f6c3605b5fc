#include "bench/run/supervisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

namespace etude {
namespace {

TEST(Supervisor, EndsWhenWorkersKeepDyingInTheirSetupAndLosesNoWorld) {
  ::signal(SIGPIPE, SIG_IGN);
  const std::vector<World> worlds(1000);
  int delivered = 0;
  const auto count = [&](const WorldAnswer&) -> Result<void> {
    ++delivered;
    return {};
  };
  const auto whole = RunWorlds(SuiteSetup{}, {}, worlds, {.program = "/bin/false", .jobs = 2}, count);
  ASSERT_FALSE(whole);
  EXPECT_THAT(ToString(whole.error()), testing::HasSubstr("3 workers in a row ended in their set-up"));
  EXPECT_THAT(ToString(whole.error()), testing::HasSubstr("exit code 1"));
  EXPECT_EQ(delivered, 0);
}

}  // namespace
}  // namespace etude
