#include "io/process/child_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/process/closed_environment.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

void WaitForOutput(const ChildProcess& child) {
  pollfd events[] = {{child.output(), POLLIN, 0}, {child.input(), POLLOUT, 0}};
  ::poll(events, child.HasUnsent() ? 2 : 1, 5000);
}

std::vector<std::string> LinesUntilEnd(ChildProcess& child) {
  std::vector<std::string> lines;
  for (bool alive = true; alive;) {
    WaitForOutput(child);
    alive = child.Receive();
    while (const auto line = child.NextLine()) lines.push_back(*line);
  }
  return lines;
}

std::string ReadLine(ChildProcess& child) {
  for (bool alive = true; alive;) {
    if (const auto line = child.NextLine()) return *line;
    WaitForOutput(child);
    alive = child.Receive();
  }
  return child.NextLine().value_or("(it ended)");
}

ChildProcess Shell(const std::string& script, const std::string& error_file = "") {
  auto child = ChildProcess::Start({.program = "/bin/sh", .arguments = {"-c", script}, .error_file = error_file});
  EXPECT_TRUE(child);
  return std::move(*child);
}

/// Returns true if the process ends within `most` hundredths of a second; a zombie counts as ended.
bool VanishesSoon(pid_t process, int most = 6000) {
  for (int i = 0; i < most; ++i, ::usleep(10000)) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    const std::string stat{std::istreambuf_iterator<char>(file), {}};
    if (stat.empty() || stat.find(") Z ") != std::string::npos) return true;
  }
  return false;
}

TEST(ChildProcess, SpeaksInLinesHoweverTheyArrive) {
  ChildProcess child = Shell(
      "printf 'one\\ntw'; sleep 0.05; printf 'o\\n'; read x; echo \"heard $x\"; head -c 300000 /dev/zero | tr '\\0' a; "
      "echo");
  EXPECT_TRUE(child.Send("me"));
  const auto lines = LinesUntilEnd(child);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "one");
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
  ChildProcess told = Shell("sh -c 'kill -SEGV $$'"), failed = Shell("exit 255");
  LinesUntilEnd(told);
  LinesUntilEnd(failed);
  EXPECT_EQ(told.Finish(), "signal 11 (Segmentation fault)") << "as its shell tells it";
  EXPECT_EQ(failed.Finish(), "exit code 255");
}

TEST(ChildProcess, AProgramThatCannotBeStartedIsAnError) {
  const auto complaint = [](const std::string& program) {
    return testing::Refusal(ChildProcess::Start({.program = program, .arguments = {}, .error_file = ""}));
  };
  EXPECT_EQ(complaint("/no/such/program"), "/no/such/program: no such program: No such file or directory");
  EXPECT_EQ(complaint("/etc/passwd"), "/etc/passwd: this file is not an executable program");
  EXPECT_EQ(complaint("/tmp"), "/tmp: this file is not an executable program");
  EXPECT_THAT(complaint("no-such-program"), HasSubstr("no program 'no-such-program' in PATH ("));
  const std::string script = ::testing::TempDir() + "no_interpreter";
  std::ofstream(script) << "#!/no/such/interpreter\n";
  ::chmod(script.c_str(), 0755);
  EXPECT_EQ(complaint(script), script + ": cannot be executed: No such file or directory");
}

TEST(ChildProcess, FindsAProgramInPathAsAShellDoes) {
  auto child = ChildProcess::Start({.program = "sh", .arguments = {"-c", "echo $0"}, .error_file = ""});
  ASSERT_TRUE(child);
  EXPECT_EQ(ReadLine(*child), "sh");
}

TEST(ChildProcess, IsKilledWhenItDoesNotEndByItself) {
  ChildProcess child = Shell("trap '' TERM; while :; do sleep 1; done");
  EXPECT_EQ(child.Finish(), "signal 9 (Killed)");
}

TEST(ChildProcess, GivesTheChildTheTimeItIsAllowedToEnd) {
  ChildProcess child = Shell("cat; sleep 0.2; exit 4");
  EXPECT_EQ(child.Finish(5000), "exit code 4");
}

TEST(ChildProcess, WhatItHasStartedIsKilledWithIt) {
  for (const char* start : {"sleep 100 &", "setsid sleep 100 &", "(setsid sh -c 'sleep 100 & echo $! >&2') 2>&1;"}) {
    ChildProcess child = Shell(std::string(start) + " [ -n \"$!\" ] && echo $!; echo; read x");
    const pid_t grandchild = std::stoi(ReadLine(child));
    EXPECT_EQ(::kill(grandchild, 0), 0) << start;
    child.Finish();
    EXPECT_TRUE(VanishesSoon(grandchild)) << start;
  }
}

TEST(ChildProcess, ADeadChildsGroupIsKilledToo) {
  ChildProcess child = Shell("sleep 100 & echo $!; read x; exit 1");
  const pid_t grandchild = std::stoi(ReadLine(child));
  EXPECT_FALSE(child.HasEnded());
  child.Send("end");
  for (int i = 0; i < 60000 && !child.HasEnded(); ++i) ::usleep(1000);
  EXPECT_TRUE(child.HasEnded());
  EXPECT_TRUE(child.Receive()) << "its output is still held open";
  EXPECT_EQ(child.Finish(), "exit code 1");
  EXPECT_TRUE(VanishesSoon(grandchild));
}

// Each case runs in a forked process, because a process that adopts orphans must have no other children.
TEST(ChildProcess, WhoAdoptsOrphansEndsTheDaemonThatAChildStartsAsItEnds) {
  for (const bool adopts : {false, true}) {
    const std::string file = ::testing::TempDir() + "daemon-" + std::to_string(adopts);
    std::ofstream(file) << "";
    const pid_t we = ::fork();
    if (we == 0) {
      if (adopts) AdoptOrphans();
      ChildProcess other = Shell("echo $$; read x");
      const std::string number = ReadLine(other);
      ChildProcess child = Shell("cat; setsid sh -c '(sleep 5 & echo $! >" + file + ") &'; sleep 0.2");
      child.Finish(5000);
      ::_exit(other.HasEnded() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(we, &status, 0);
    EXPECT_EQ(status, 0) << "a child that is spoken to is no orphan";
    pid_t daemon = 0;
    std::ifstream(file) >> daemon;
    ASSERT_GT(daemon, 0);
    EXPECT_EQ(::kill(daemon, 0) != 0, adopts);
    ::kill(daemon, SIGKILL);
  }
}

TEST(ChildProcess, WhatIsNotOursIsLimited) {
  const auto words = [](bool limited) {
    auto child =
        ChildProcess::Start({.program = "/bin/sh",
                             .arguments = {"-c", "grep NoNewPrivs /proc/self/status; ulimit -c; ulimit -n; ulimit -f"},
                             .limited = limited});
    return LinesUntilEnd(*child);
  };
  EXPECT_EQ(words(true), (std::vector<std::string>{"NoNewPrivs:\t1", "0", "512", "524288"}));
  EXPECT_EQ(words(false).at(0), "NoNewPrivs:\t0");
}

TEST(ChildProcess, DiesWithUs) {
  int report[2];
  ASSERT_EQ(::pipe(report), 0);
  const pid_t we = ::fork();
  if (we == 0) {
    // With `exec`, closing our end closes the input of the program itself; a child of the shell would survive.
    ChildProcess child = Shell("echo $$; read x; exec sleep 100");
    const std::string line = ReadLine(child) + "\n";
    if (::write(report[1], line.data(), line.size()) < 0) ::_exit(1);
    ::pause();
  }
  char digits[32] = {};
  ASSERT_GT(::read(report[0], digits, sizeof digits - 1), 0);
  ::kill(we, SIGKILL);
  ::waitpid(we, nullptr, 0);
  EXPECT_TRUE(VanishesSoon(std::stoi(digits)));
  ::close(report[0]);
  ::close(report[1]);
}

/// A child starts a process in a session of its own, so no signal tells this process that the child has ended. Only
/// the child is killed from outside. Returns true if the other process ends, too, without our doing.
bool IsEndedWithTheChild(bool contained) {
  auto child = ChildProcess::Start(
      {.program = "/bin/sh", .arguments = {"-c", "setsid sleep 100 & echo; read x"}, .contained = contained});
  EXPECT_TRUE(child);
  ReadLine(*child);
  const pid_t other = child->FirstStarted();
  const std::vector<pid_t> ours = ChildrenOf(::getpid());
  EXPECT_EQ(ours.size(), 1u);
  ::kill(ours.at(0), SIGKILL);
  const bool is_ended = VanishesSoon(other, contained ? 6000 : 200);
  ::kill(other, SIGKILL);
  return is_ended;
}

TEST(ChildProcess, InASpaceOfItsOwnItTakesAllThatItHasStartedWithIt) {
  auto child = ChildProcess::Start({.program = "/bin/sh", .arguments = {"-c", "echo $$"}, .contained = true});
  ASSERT_TRUE(child);
  if (ReadLine(*child) != "1") GTEST_SKIP() << "the kernel grants no space of its own";
  child->Finish();
  EXPECT_TRUE(IsEndedWithTheChild(true));
  EXPECT_FALSE(IsEndedWithTheChild(false)) << "the control: else nobody ends it";
}

TEST(ChildProcess, ReadsWhatItIsToldFromItsDescriptors) {
  auto child = ChildProcess::Start(
      {.program = "/bin/sh", .arguments = {"-c", "cat <&3; echo; cat <&4; echo"}, .inherited_texts = {"one", "two"}});
  ASSERT_TRUE(child);
  EXPECT_THAT(LinesUntilEnd(*child), ::testing::ElementsAre("one", "two"));
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

// Variables that configure the renderer, the loader or libraries do not pass; two lists define the environment.
TEST(ChildProcess, TakesNothingFromTheShellThatIsNotOnTheList) {
  const std::vector<std::string> knobs = {
      "LP_PERF", "GALLIUM_DRIVER", "LP_NATIVE_VECTOR_WIDTH", "OPENBLAS_NUM_THREADS", "LD_BIND_NOW", "MALLOC_ARENA_MAX",
      "LANG"};
  for (const std::string& name : knobs) ::setenv(name.c_str(), "1", 1);
  ::setenv("TERM", "dumb", 1);
  ChildProcess child = Shell("env");
  const auto lines = LinesUntilEnd(child);
  for (const std::string& name : knobs) {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), name + "=1"), 0) << name;
    ::unsetenv(name.c_str());
  }
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "TERM=dumb"), 1) << "the control: what may pass does";
}

TEST(PinnedEnvironment, IsWhatTheTestsThemselvesRunIn) {
  for (const std::string& setting : PinnedEnvironment()) {
    const std::string name = setting.substr(0, setting.find('='));
    const char* value = ::getenv(name.c_str());
    ASSERT_NE(value, nullptr) << name << " is not set: run the tests through ctest";
    EXPECT_EQ(name + "=" + value, setting);
  }
}

TEST(ChildProcess, InheritsNoFilesOfOurs) {
  const int ours = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  ChildProcess child = Shell("ls /proc/$$/fd");
  EXPECT_THAT(LinesUntilEnd(child), ::testing::ElementsAre("0", "1", "2"));
  ::close(ours);
}

TEST(ChildProcess, SendingToADeadChildFailsInsteadOfKillingUs) {
  ::signal(SIGPIPE, SIG_DFL);
  ChildProcess child = Shell("exit 0");
  LinesUntilEnd(child);
  bool listens = true;  // its input may close shortly before or after its output
  for (int i = 0; i < 60000 && listens; ++i, ::usleep(1000)) listens = child.Send("x");
  EXPECT_FALSE(listens);
  EXPECT_FALSE(child.HasUnsent());
}

TEST(ChildProcess, SendsWithoutWaitingForTheChild) {
  const std::string long_line(3000000, 'x');  // much more than a pipe holds
  ChildProcess deaf = Shell("sleep 100"), listens = Shell("head -c 3000007 | wc -c");
  for (ChildProcess* child : {&deaf, &listens}) {
    EXPECT_TRUE(child->Send(long_line));
    EXPECT_TRUE(child->Send("after"));
  }
  EXPECT_TRUE(deaf.HasUnsent());
  EXPECT_EQ(ReadLine(listens), "3000007");
  EXPECT_FALSE(listens.HasUnsent());
}

TEST(ChildProcess, ALineBeyondTheLimitEndsTheConversation) {
  ChildProcess child = Shell("echo short; head -c 100000 /dev/zero | tr '\\0' a; sleep 100");
  EXPECT_EQ(ReadLine(child), "short");
  bool goes_on = true;
  while (goes_on) {
    WaitForOutput(child);
    goes_on = child.Receive(1000);
    EXPECT_FALSE(child.NextLine());
  }
  EXPECT_FALSE(goes_on);
  EXPECT_GT(child.PartOfLine().size(), 1000u);
}

TEST(ChildProcess, AChildThatNeverStopsTalkingDoesNotKeepReceiveBusy) {
  ChildProcess child = Shell("yes");
  for (int i = 0; i < 3; ++i) {
    WaitForOutput(child);
    ASSERT_TRUE(child.Receive());
    EXPECT_LE(child.PartOfLine().size(), std::size_t{1} << 20);
    while (const auto line = child.NextLine()) ASSERT_EQ(*line, "y");
  }
}

TEST(ChildProcess, KeepsItsStandardErrorInAFile) {
  const std::string path = ::testing::TempDir() + "standard_error";
  std::ofstream(path) << "before\n";
  for (const char* word : {"one", "two"}) Shell(std::string("echo ") + word + " >&2", path).Finish(5000);
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "before\none\ntwo\n");
  EXPECT_EQ(
      testing::Refusal(ChildProcess::Start({.program = "sh", .arguments = {}, .error_file = "/no/such/folder/file"})),
      "/no/such/folder/file: cannot write: No such file or directory");
}

}  // namespace
}  // namespace etude
