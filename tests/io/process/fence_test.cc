#include "io/process/fence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "engine/base/machine.h"
#include "io/process/child_process.h"

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
                              .contained = !command.inherited_texts.empty(),
                              .inherited_texts = command.inherited_texts,
                              .environment = command.environment});
}

/// Returns the output of a script in the fence.
std::string Say(const Fence& fence, const std::string& script, const std::vector<fs::path>& shown = {},
                const fs::path& start = {}) {
  auto child = Start(fence.Around({"/bin/sh", "-c", script + " 2>&1"}, shown, start));
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
  EXPECT_THAT(said, ::testing::HasSubstr("/bin/sh")) << "the first process";
  EXPECT_THAT(said, ::testing::HasSubstr("PATH="));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr(here + "/")));
  EXPECT_THAT(said, ::testing::Not(::testing::HasSubstr("PWD=" + here)));
  EXPECT_EQ(Say(TheFence(), "ls /proc/self/fd | grep -v '^[0-2]$' | wc -l"), "1\n") << "ls's own alone";
}

// Bubblewrap's own process would know all mounts, including the names of hidden ones.
TEST_F(FenceTest, TheFirstProcessRemembersNoMounts) {
  const std::string look =
      "python3 -c \"\nimport re\nmounts = words = 0\nmemory = open('/proc/1/mem', 'rb', 0)\nfor line in "
      "open('/proc/1/maps'):\n"
      "  start, end = (int(n, 16) for n in line.split()[0].split('-'))\n  try:\n    memory.seek(start)\n"
      "    bytes = memory.read(end - start)\n    mounts += len(re.findall(b'--ro-bin[d]', bytes))\n"
      "    words += len(re.findall(b'/bin/s[h]', bytes))\n  except (OSError, OverflowError):\n"
      "    pass\nprint(mounts, words > 0)\"";
  EXPECT_EQ(Say(TheFence(), look), "0 True\n");
}

TEST_F(FenceTest, OfTheSettingsItShowsThoseOfLibrariesAndOfUsersOneWithoutAName) {
  EXPECT_EQ(Say(TheFence(), "id -un; id -gn; cat /etc/passwd | wc -l; cat /etc/group | wc -l"), "user\nuser\n1\n1\n");
  const std::string others =
      "for f in hostname machine-id shadow passwd- ssl/private; do test -e /etc/$f && echo $f; done";
  EXPECT_EQ(Say(TheFence(), others), "");
  EXPECT_NE(Say(Fence(), others), "") << "the control";
  EXPECT_EQ(Say(TheFence(), "python3 -c 'import ssl, encodings.idna; print(1)'"), "1\n");
  EXPECT_NE(Say(TheFence(), "head -1 /etc/hosts", {"/etc/hosts"}), "") << "it is granted";
  EXPECT_FALSE(Fence::IsOfSystem("/etc"));
  EXPECT_FALSE(Fence::IsOfSystem("/etc/shadow"));
  EXPECT_FALSE(Fence::IsOfSystem("/etc/ssl/private/key"));
  EXPECT_TRUE(Fence::IsOfSystem("/etc/ssl/certs/one.pem"));
  EXPECT_TRUE(Fence::IsOfSystem("/etc/python3.11/sitecustomize.py"));
}

// A listener at a visible socket or pipe could hear a program in the fence.
TEST_F(FenceTest, SocketsAndPipesInAFolderThatIsShownAreFoundAndCanBeHidden) {
  const fs::path folder = folder_;
  fs::create_directory(folder / "below");
  ASSERT_EQ(::mkfifo((folder / "below" / "pipe").c_str(), 0666), 0);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  (folder / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_THAT(Fence::PipesBelow(folder), ::testing::UnorderedElementsAre(folder / "below" / "pipe", folder / "socket"));
  const std::string look =
      "test -p " + folder_ + "/below/pipe && echo pipe; test -S " + folder_ + "/socket && echo socket";
  EXPECT_EQ(Say(TheFence(), look, {folder}), "pipe\nsocket\n") << "the control";
  Fence fence = TheFence();
  for (const fs::path& one : Fence::PipesBelow(folder)) fence.Hide(one);
  EXPECT_EQ(Say(fence, look + "; ls " + folder_ + "/below", {folder}), "pipe\n");
  ::close(listener);
}

TEST(ProgramLimits, WhatTheKernelCountsByUserIsSharedByThoseThatRunAtTheSameTime) {
  for (const int programs : {1, 2, 4, 16, 48}) {
    EXPECT_LE(programs * ProgramLimits::InotifyInstances(programs), 64) << programs;
    EXPECT_LE(static_cast<std::size_t>(programs) * ProgramLimits::Pipes(programs), 768u) << programs;
  }
  EXPECT_EQ(ProgramLimits::InotifyInstances(1), 8);
  EXPECT_EQ(ProgramLimits::Pipes(1), 256u);
  EXPECT_EQ(ProgramLimits::InotifyInstances(1000), 1) << "each has one at least";
  EXPECT_EQ(ProgramLimits::Threads(1, 100000), ProgramLimits::kThreads);
  EXPECT_EQ(ProgramLimits::Threads(4, 16000), 2000u);
  EXPECT_EQ(ProgramLimits::Threads(4, 100), 64u);
}

TEST_F(FenceTest, TellsNothingOfTheUserInAnyEnvironment) {
  std::map<const char*, std::string> before;
  for (const char* name : {"PATH", "HOME", "USER", "LOGNAME", "SHELL"}) {
    const char* value = ::getenv(name);
    before[name] = value != nullptr ? value : "";
    ::setenv(name, "/home/me", 1);
  }
  ::setenv("PATH", ("/home/me/bin:" + folder_ + ":/usr/bin:/bin").c_str(), 1);
  const std::string look =
      "cat /proc/[0-9]*/environ 2>/dev/null | tr '\\0' '\\n' | grep -E 'home/me|^(HOME|PATH)=' | sort -u";
  const std::string fenced = Say(TheFence(), look), shown = Say(TheFence(), look, {folder_}), open = Say(Fence(), look);
  for (const auto& [name, value] : before) ::setenv(name, value.c_str(), 1);
  EXPECT_EQ(fenced, "HOME=/tmp\nPATH=/usr/bin:/bin\n");
  EXPECT_EQ(shown, "HOME=/tmp\nPATH=" + folder_ + ":/usr/bin:/bin\n");
  EXPECT_THAT(open, ::testing::HasSubstr("USER=/home/me\n")) << "the control";
}

// A method must not change the machine's settings or read its secrets, even if root runs it.
TEST_F(FenceTest, MachineIsReadOnlyAndSecretsAreNotShownToRootEither) {
  const std::string mounts = "awk '$6 ~ /^rw/ {print $5}' /proc/self/mountinfo | sort | tr '\\n' ' '; echo";
  EXPECT_EQ(Say(TheFence(), mounts, {folder_}),
            "/dev/full /dev/null /dev/random /dev/shm /dev/tty /dev/urandom /dev/zero /tmp /var/tmp \n");
  const std::string count = "find /proc/sys /proc/irq -writable -printf '%M\\n' | grep -c ^-";
  EXPECT_EQ(Say(TheFence(), count), "0\n");
  const std::string secrets = "cat /etc/shadow /proc/slabinfo /proc/sys/kernel/usermodehelper/bset 2>/dev/null | wc -c";
  EXPECT_EQ(Say(TheFence(), secrets), "0\n");
  if (::geteuid() != 0) GTEST_SKIP() << "the controls, which only root can change and read";
  EXPECT_NE(Say(Fence(), count), "0\n");
  EXPECT_NE(Say(Fence(), secrets), "0\n");
  EXPECT_NE(Say(TheFence(), secrets, {"/etc/shadow"}), "0\n") << "it is granted";
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
  const std::string script =
      "for f in /tmp /var/tmp /dev/shm; do head -c 20M /dev/zero >$f/a; done; echo; read x; "
      "cd /tmp; touch $(seq 3000); echo; read x";
  auto child = Start(TheFence().Around({"/bin/sh", "-c", script}, {}));
  while (child->Receive() && !child->NextLine()) ::usleep(1000);
  EXPECT_NEAR(TheFence().MeasureScratch(child->FirstStarted()).Mb(), 60, 1);
  EXPECT_EQ(Fence().MeasureScratch(child->FirstStarted()).Mb(), 0);
  child->Send("");
  while (child->Receive() && !child->NextLine()) ::usleep(1000);
  EXPECT_NEAR(TheFence().MeasureScratch(child->FirstStarted()).Mb(), 64.8, 1.2) << "3000 files without a byte";
}

TEST_F(FenceTest, RefusesMemoryThatCannotBeCountedAndSocketsThatCannotBeFenced) {
  std::ofstream(folder_ + "/tries.py") << R"(
import ctypes, errno, fcntl, mmap, os, socket, struct
libc = ctypes.CDLL(None, use_errno=True)
libc.mmap.restype = ctypes.c_void_p
def say(name, result): print(name, 'made' if result not in (-1, 2**64 - 1) else errno.errorcode[ctypes.get_errno()])
def call(name, x86_64, aarch64, *words):
    say(name, libc.syscall({'x86_64': x86_64, 'aarch64': aarch64}[os.uname().machine], *words))
call('memfd_create', 319, 279, b'x', 0)
call('shmget', 29, 194, 0, 4096, 0o1600)
call('msgget', 68, 186, 0, 0o1600)
call('semget', 64, 190, 0, 1, 0o1600)
call('mq_open', 240, 180, b'x', os.O_CREAT | os.O_RDWR, 0o600, 0)
call('vmsplice', 278, 75, os.pipe()[1], 0, 0, 0)
call('splice', 275, 76, 0, 0, 0, 0, 0, 0)
call('sendfile', 40, 71, 1, 0, 0, 0)
call('seccomp', 317, 277, 2, 0, 0)
say('PR_SET_SECCOMP', libc.prctl(22, 2, 0))
call('userfaultfd', 323, 282, 1)
call('io_setup', 206, 0, 1, ctypes.byref(ctypes.c_ulong(0)))
call('io_uring_setup', 425, 425, 1, bytes(120))
call('keyctl', 250, 219, 0, -3, 0)
def set_pipe(size): return libc.fcntl(os.pipe()[1], 1031, size)
say('F_SETPIPE_SZ', set_pipe(1 << 16))
with open('/tmp/' + str(os.getpid()), 'w+') as file:
    say('F_OFD_SETLK', libc.fcntl(file.fileno(), 37, struct.pack('hhqqi', 1, 0, 0, 1, 0)))
    say('F_SETLK', libc.fcntl(file.fileno(), 6, struct.pack('hhqqi', 1, 0, 0, 1, 0)))
os.unlink('/tmp/' + str(os.getpid()))
say('MAP_HUGETLB', libc.mmap(None, 2 << 20, 3, 0x40022, -1, 0))
with socket.socket(socket.AF_UNIX) as link:
    before = link.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF)
    link.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, before // 4)
    print('SO_SNDBUF', 'kept' if link.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF) == before else 'set')
    program = (ctypes.c_char * 8)(*struct.pack('HBBI', 6, 0, 0, 0))
    try: link.setsockopt(socket.SOL_SOCKET, 26, struct.pack('HxxxxxxP', 1, ctypes.addressof(program))); print('SO_ATTACH_FILTER set')
    except OSError: print('SO_ATTACH_FILTER refused')
def open_socket(family):
    try: return socket.socket(family, socket.SOCK_STREAM).close() or 'made'
    except OSError as error: return errno.errorcode[error.errno]
print('sockets', *map(open_socket, (socket.AF_UNIX, socket.AF_INET, 40)))
)";
  const std::string script = "/usr/bin/python3 " + folder_ + "/tries.py";
  EXPECT_EQ(Say(TheFence(), script, {folder_}),
            "memfd_create ENOSYS\nshmget ENOSYS\nmsgget ENOSYS\nsemget ENOSYS\nmq_open ENOSYS\nvmsplice ENOSYS\n"
            "splice EINVAL\nsendfile EINVAL\nseccomp EINVAL\nPR_SET_SECCOMP EINVAL\n"
            "userfaultfd ENOSYS\nio_setup ENOSYS\nio_uring_setup ENOSYS\nkeyctl ENOSYS\n"
            "F_SETPIPE_SZ EPERM\nF_OFD_SETLK EINVAL\nF_SETLK made\nMAP_HUGETLB ENOMEM\nSO_SNDBUF kept\n"
            "SO_ATTACH_FILTER refused\nsockets made made EAFNOSUPPORT\n");
  const std::string control = Say(Fence(), script);
  for (const char* name :
       {"memfd_create made", "shmget made", "semget made", "F_SETPIPE_SZ made", "F_OFD_SETLK made", "SO_SNDBUF set"}) {
    EXPECT_THAT(control, ::testing::HasSubstr(name)) << "the control";
  }
}

TEST_F(FenceTest, LeavesItsUserInotifyInstancesTimersAndLocks) {
  std::ofstream(folder_ + "/takes.py") << R"(
import ctypes, resource, signal
libc = ctypes.CDLL(None)
def count(make, most):
    taken = 0
    while taken < most and make() >= 0: taken += 1
    return taken
timer = ctypes.c_void_p()
print(count(lambda: libc.inotify_init1(0), 100), count(lambda: libc.timer_create(1, None, ctypes.byref(timer)), 2000))
)";
  const std::string script = "/usr/bin/python3 " + folder_ + "/takes.py";
  EXPECT_EQ(Say(TheFence(), script, {folder_}), "8 1024\n");
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
