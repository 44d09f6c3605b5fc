#include "bench/process/fence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "bench/process/child_process.h"
#include "engine/base/machine.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

const Fence& TheFence() {
  static const Fence fence = Fence::Find();
  return fence;
}

Result<ChildProcess> Start(const FencedCommand& command) {
  return ChildProcess::Start({.program = command.words[0],
                              .arguments = {command.words.begin() + 1, command.words.end()},
                              .limited = true,
                              .contained = !command.told.empty(),
                              .told = command.told});
}

/// All that a script says in the fence.
std::string Say(const Fence& fence, const std::string& script, const std::vector<fs::path>& shown = {},
                const fs::path& start = {}) {
  const FencedCommand command = fence.Around({"/bin/sh", "-c", script + " 2>&1"}, shown, start);
  auto child = Start(command);
  std::string said;
  for (bool open = true; open;) {
    pollfd watched{child->output(), POLLIN, 0};
    if (::poll(&watched, 1, 10000) <= 0) return said + "(no end)";
    open = child->Receive();
    while (auto line = child->NextLine()) said += *line + "\n";
  }
  return said;
}

class FenceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!TheFence().IsUp()) GTEST_SKIP() << TheFence().description();
    folder_ = ::testing::TempDir() + "fence-test-XXXXXX";
    ASSERT_NE(::mkdtemp(folder_.data()), nullptr);
    std::ofstream(folder_ + "/secret.txt") << "the truth\n";
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  std::string folder_;
};

TEST_F(FenceTest, SaysWhatItIsMadeOf) { EXPECT_THAT(TheFence().description(), ::testing::StartsWith("bubblewrap ")); }

TEST_F(FenceTest, RunsAProgramWhereItIsAskedTo) {
  EXPECT_EQ(Say(TheFence(), "pwd"), "/tmp\n");
  EXPECT_EQ(Say(TheFence(), "pwd; ls", {folder_}, folder_), folder_ + "\nsecret.txt\n");
  EXPECT_EQ(Say(TheFence(), "exit 3"), "");
}

TEST_F(FenceTest, ShowsTheSystemAndNothingOfOurs) {
  EXPECT_THAT(Say(TheFence(), "ls /usr/bin/env /etc/passwd"), ::testing::HasSubstr("/etc/passwd"));
  for (const std::string& ours :
       {fs::current_path().string(), std::string("/root"), std::string("/home"), std::string("/srv"),
        std::string("/mnt"), fs::read_symlink("/proc/self/exe").string()}) {
    EXPECT_EQ(Say(TheFence(), "test -e " + ours + " && echo seen"), "") << ours;
  }
}

TEST_F(FenceTest, NamesNothingOfOurs) {
  const std::string here = fs::current_path().string();
  const std::string look =
      "tr '\\0' '\\n' </proc/1/cmdline; tr '\\0' '\\n' </proc/1/environ; cat /proc/self/mountinfo; "
      "ls -l /proc/[0-9]*/fd/ /proc/[0-9]*/cwd; cat /proc/[0-9]*/environ | tr '\\0' '\\n'";
  const std::string said = Say(TheFence(), look);
  EXPECT_THAT(said, ::testing::HasSubstr("--args"));
  EXPECT_THAT(said, ::testing::HasSubstr("PATH="));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr(here + "/")));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("PWD=" + here)));
  EXPECT_EQ(Say(TheFence(), "ls /proc/self/fd | grep -v '^[0-2]$' | wc -l"), "1\n") << "ls's own alone";
}

TEST_F(FenceTest, HoldsNoProcessButItsOwn) {
  const std::string script = "kill -0 " + std::to_string(::getpid()) + " 2>/dev/null && echo seen || echo none";
  EXPECT_EQ(Say(TheFence(), script), "none\n");
  EXPECT_EQ(Say(Fence(), script), "seen\n");
}

TEST_F(FenceTest, HasNoNetworkAndNoPrivileges) {
  EXPECT_EQ(Say(TheFence(), "cat /proc/net/dev | grep -c :"), "1\n") << "loopback only";
  EXPECT_EQ(Say(TheFence(), "grep -E 'NoNewPrivs|CapEff' /proc/self/status"),
            "CapEff:\t0000000000000000\nNoNewPrivs:\t1\n");
}

TEST_F(FenceTest, CanWriteOnlyToScratchFoldersThatGoWithIt) {
  const std::string script = "for f in /tmp /var/tmp /dev/shm / /dev /run /etc " + folder_ +
                             "; do (echo x > $f/of-the-fence-test) 2>/dev/null && echo $f; done";
  EXPECT_EQ(Say(TheFence(), script, {folder_}), "/tmp\n/var/tmp\n/dev/shm\n");
  for (const char* folder : {"/tmp", "/var/tmp", "/dev/shm"}) {
    EXPECT_FALSE(fs::exists(fs::path(folder) / "of-the-fence-test")) << folder;
  }
}

TEST_F(FenceTest, ScratchFoldersAreBounded) {
  EXPECT_EQ(Say(TheFence(), "head -c 300M /dev/zero >/tmp/a; wc -c </tmp/a"), "268435456\n");
}

TEST_F(FenceTest, WhatIsInScratchFoldersIsCounted) {
  const std::string script = "for f in /tmp /var/tmp /dev/shm; do head -c 20M /dev/zero >$f/a; done; echo; read x";
  auto child = Start(TheFence().Around({"/bin/sh", "-c", script}, {}));
  while (child->Receive() && !child->NextLine()) ::usleep(1000);
  EXPECT_NEAR(TheFence().ScratchMb(child->FirstStarted()), 60, 1);
  EXPECT_EQ(Fence().ScratchMb(child->FirstStarted()), 0);
}

TEST_F(FenceTest, RefusesMemoryThatCannotBeCountedAndSocketsThatCannotBeFenced) {
  std::ofstream(folder_ + "/tries.py") << R"(
import ctypes, errno, os, socket
libc = ctypes.CDLL(None, use_errno=True)
def call(*words): return 'made' if libc.syscall(*words) >= 0 else errno.errorcode[ctypes.get_errno()]
def open_socket(family):
    try: return socket.socket(family, socket.SOCK_STREAM).close() or 'made'
    except OSError as error: return errno.errorcode[error.errno]
try: memory = os.memfd_create('x') and 'made'
except OSError as error: memory = errno.errorcode[error.errno]
numbers = {'x86_64': (29, 250), 'aarch64': (194, 219)}[os.uname().machine]
print(memory, call(numbers[0], 0, 4096, 0o1600), call(numbers[1], 0, -3, 0), call(425, 1, 0),
      open_socket(socket.AF_UNIX), open_socket(socket.AF_INET), open_socket(40))
)";
  const std::string script = "/usr/bin/python3 " + folder_ + "/tries.py";
  EXPECT_EQ(Say(TheFence(), script, {folder_}), "ENOSYS ENOSYS ENOSYS ENOSYS made made EAFNOSUPPORT\n");
  EXPECT_THAT(Say(Fence(), script), ::testing::StartsWith("made made ")) << "the control";
}

TEST_F(FenceTest, ToldAgainItSaysWhetherAnythingCanBeRunInside) {
  EXPECT_TRUE(TheFence().Try());
  EXPECT_TRUE(Fence().Try());
  const auto broken = Fence::Of("/bin/false").Try();
  ASSERT_FALSE(broken);
  EXPECT_TRUE(IsOfThisMachine(broken.error()));
}

TEST_F(FenceTest, OfTemporaryFoldersItSeesWhatItIsShown) {
  const std::string read = "cat " + folder_ + "/secret.txt";
  EXPECT_THAT(Say(TheFence(), read), ::testing::HasSubstr("No such file"));
  EXPECT_EQ(Say(TheFence(), read, {folder_}), "the truth\n");
  EXPECT_EQ(Say(TheFence(), read, {folder_ + "/secret.txt"}), "the truth\n");
}

TEST_F(FenceTest, WhatIsHiddenIsEmpty) {
  Fence fence = TheFence();
  fence.Hide(folder_);
  EXPECT_EQ(Say(fence, "ls " + folder_, {folder_}), "");
  EXPECT_EQ(Say(TheFence(), "ls " + folder_, {folder_}), "secret.txt\n");
  fence = TheFence();
  fence.Hide("/usr/include");
  fence.Hide(folder_ + "/secret.txt");
  EXPECT_EQ(Say(fence, "ls /usr/include; cat " + folder_ + "/secret.txt && echo read", {folder_}), "");
}

}  // namespace
}  // namespace etude
