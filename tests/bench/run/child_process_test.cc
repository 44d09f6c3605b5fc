#include "bench/run/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <string>
#include <vector>

namespace etude {
namespace {

/// Reads until the child ends; gives its lines.
std::vector<std::string> LinesUntilEnd(ChildProcess& child) {
  std::vector<std::string> lines;
  for (bool alive = true; alive;) {
    pollfd output{child.output(), POLLIN, 0};
    ::poll(&output, 1, 5000);
    alive = child.Receive();
    while (const auto line = child.NextLine()) lines.push_back(*line);
  }
  return lines;
}

ChildProcess Shell(const std::string& script) {
  auto child = ChildProcess::Start("/bin/sh", {"-c", script});
  EXPECT_TRUE(child);
  return std::move(*child);
}

TEST(ChildProcess, SpeaksInLinesHoweverTheyArrive) {
  ChildProcess child = Shell(
      "printf 'one\\ntw'; sleep 0.05; printf 'o\\n'; read x; echo \"heard $x\"; head -c 300000 /dev/zero | tr '\\0' a; "
      "echo");
  EXPECT_TRUE(child.Send("me"));
  const auto lines = LinesUntilEnd(child);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[1], "two");
  EXPECT_EQ(lines[2], "heard me");
  EXPECT_EQ(lines[3].size(), 300000u);
  EXPECT_EQ(child.Finish(), "exit code 0");
}

TEST(ChildProcess, TellsHowItEnded) {
  ChildProcess exits = Shell("exit 3"), crashes = Shell("kill -SEGV $$");
  LinesUntilEnd(exits);
  LinesUntilEnd(crashes);
  EXPECT_EQ(exits.Finish(), "exit code 3");
  EXPECT_EQ(crashes.Finish(), "signal 11 (Segmentation fault)");
  auto missing = ChildProcess::Start("/no/such/program", {});
  ASSERT_TRUE(missing);
  LinesUntilEnd(*missing);
  EXPECT_EQ(missing->Finish(), "exit code 127");
}

TEST(ChildProcess, IsKilledWhenItDoesNotEndByItself) {
  ChildProcess child = Shell("trap '' TERM; while :; do sleep 1; done");
  EXPECT_EQ(child.Finish(), "signal 9 (Killed)");
}

TEST(ChildProcess, RunsInThePinnedEnvironmentWhateverOursIs) {
  ::setenv("LP_NUM_THREADS", "7", 1);
  ChildProcess child = Shell("env");
  const auto lines = LinesUntilEnd(child);
  for (const std::string& setting : PinnedEnvironment()) {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), setting), 1) << setting;
  }
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "LP_NUM_THREADS=7"), 0);
  ::setenv("LP_NUM_THREADS", "0", 1);
}

TEST(PinnedEnvironment, IsWhatTheTestsThemselvesRunIn) {
  for (const std::string& setting : PinnedEnvironment()) {
    const std::string name = setting.substr(0, setting.find('='));
    const char* value = ::getenv(name.c_str());
    ASSERT_NE(value, nullptr) << name << " is not set: run the tests through ctest";
    EXPECT_EQ(name + "=" + value, setting);
  }
}

TEST(ChildProcess, SendingToADeadChildFailsInsteadOfKillingUs) {
  ::signal(SIGPIPE, SIG_IGN);
  ChildProcess child = Shell("exit 0");
  LinesUntilEnd(child);
  EXPECT_FALSE(child.Send(std::string(1 << 20, 'x')));
}

}  // namespace
}  // namespace etude
