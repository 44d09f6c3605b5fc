#include "io/process/tree_meter.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "io/process/child_process.h"
#include "io/process/fence.h"
#include "io/process/process_tree.h"

namespace etude {
namespace {

constexpr double kAlways = 0, kNever = 1e9;  // values of HeldMb's `precise_from_mb`, MB
constexpr double kNoLimit = 1e9;

std::string NextAnswer(ChildProcess& child) {
  for (bool is_open = true; is_open;) {
    if (const auto line = child.NextLine()) return *line;
    pollfd watched{child.output(), POLLIN, 0};
    ::poll(&watched, 1, 10000);
    is_open = child.Receive();
  }
  return child.NextLine().value_or("(it ended)");
}

constexpr const char* kPrelude = R"(
import ctypes, fcntl, mmap, os, socket, struct, sys, threading, time
def touch(memory, size, begin=0):
    for at in range(begin, begin + size, 4096): memory[at] = 1
def hold(): print('held', flush=True); sys.stdin.readline()
MB = 1 << 20
)";

/// Starts a Python script that reports when it holds its memory.
ChildProcess Python(const std::string& script) {
  auto child = ChildProcess::Start({.program = "/usr/bin/python3", .arguments = {"-c", kPrelude + script}});
  EXPECT_TRUE(child);
  EXPECT_EQ(NextAnswer(*child), "held");
  return std::move(*child);
}

double Look(TreeMeter& meter, double precise_from_mb = kAlways) {
  meter.Count();
  return meter.HeldMb(0, precise_from_mb);
}

/// Returns the memory (MB) that one look finds beyond Python's own.
double HeldMb(const std::string& script, double precise_from_mb = kAlways) {
  const ChildProcess plain = Python("hold()"), child = Python(script);
  TreeMeter own(plain.number(), kNoLimit), all(child.number(), kNoLimit);
  return Look(all, precise_from_mb) - Look(own, precise_from_mb);
}

// 40 idle children of a program of 20 MB hold little more.
TEST(TreeMeter, CountsAPageOnceHoweverManyProcessesShareIt) {
  const std::string script =
      "own = bytearray(os.urandom(20 * MB))\n"
      "for _ in range(40):\n"
      "  if os.fork() == 0: time.sleep(60); os._exit(0)\n"
      "hold()";
  EXPECT_NEAR(HeldMb(script), 50, 30);
  EXPECT_GT(HeldMb(script, kNever), 40 * 20) << "the control: a bound";
}

TEST(TreeMeter, MeasuresItselfAndAllThatItHasStarted) {
  // 30 MB in a child, and some work in a second one whose parent ended and which left the group.
  const ChildProcess child = Python(
      "reading, writing = os.pipe()\n"
      "if os.fork() == 0: own = bytearray(os.urandom(30 * MB)); os.write(writing, b'x'); time.sleep(60)\n"
      "if os.fork() == 0:\n"
      "  os.setsid()\n"
      "  if os.fork() == 0:\n"
      "    while sum(os.times()[:2]) < 0.05: pass\n"
      "    os.write(writing, b'x'); time.sleep(60)\n"
      "  os._exit(0)\n"
      "os.read(reading, 1); os.read(reading, 1); hold()");
  TreeMeter meter(child.number(), kNoLimit);
  EXPECT_NEAR(Look(meter), 45, 12);
  const TreeLoad load = meter.Count();
  EXPECT_GT(load.cpu_s, 0.02);
  EXPECT_EQ(load.processes, 4u);
}

TEST(TreeMeter, SeesPagesThatAChildWritesToAfterAPreciseLook) {
  ChildProcess child = Python(
      "own = bytearray(40 * MB); touch(own, 40 * MB)\n"
      "if os.fork() == 0:\n"
      "  hold(); touch(own, 40 * MB); print('held', flush=True); time.sleep(60)\n"
      "time.sleep(60)");
  TreeMeter meter(child.number(), kNoLimit);
  const double before = Look(meter);
  EXPECT_NEAR(before, 55, 12);
  child.Send("");
  EXPECT_EQ(NextAnswer(child), "held");
  EXPECT_GT(Look(meter, kNever), before + 35) << "a bound, from the pages touched";
  EXPECT_NEAR(Look(meter), before + 40, 8);
}

TEST(TreeMeter, CountsSharedMemoryByAllPartsThatWereEverMapped) {
  // 60 MB, of which each process maps a third. The first look counts all, later ones only the thirds.
  const std::string split =
      "memory = mmap.mmap(-1, 60 * MB); touch(memory, 60 * MB)\n"
      "libc = ctypes.CDLL(None); libc.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]\n"
      "start = ctypes.addressof(ctypes.c_char.from_buffer(memory))\n"
      "if os.fork() == 0: libc.munmap(start, 40 * MB); time.sleep(60)\n"
      "if os.fork() == 0: libc.munmap(start, 20 * MB); libc.munmap(start + 40 * MB, 20 * MB); time.sleep(60)\n"
      "libc.munmap(start + 20 * MB, 40 * MB); time.sleep(0.3); hold()";
  EXPECT_NEAR(HeldMb(split), 62, 8);
  ChildProcess child = Python(
      "memory = mmap.mmap(-1, 60 * MB); touch(memory, 60 * MB); hold()\n"
      "libc = ctypes.CDLL(None); libc.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]\n"
      "start = ctypes.addressof(ctypes.c_char.from_buffer(memory))\n"
      "libc.munmap(start + MB, 59 * MB); hold()\n"
      "libc.munmap(start, MB); hold()");
  TreeMeter meter(child.number(), kNoLimit);
  const auto held = [&] {
    double mb = 0;
    for (int i = 0; i < 6; ++i, ::usleep(110000)) mb = Look(meter);
    return mb;
  };
  const double whole = held();
  child.Send("");
  EXPECT_EQ(NextAnswer(child), "held");
  EXPECT_NEAR(held(), whole, 2) << "its pages stay";
  child.Send("");
  EXPECT_EQ(NextAnswer(child), "held");
  EXPECT_NEAR(held(), whole - 60, 2) << "nobody maps any of it";
}

// All pages of a shared mapping but one are unmapped before the meter first reads the mappings. Count has seen the
// number of shared pages rise and fall.
TEST(TreeMeter, CountsSharedMemoryBehindAPageThatStaysMapped) {
  ChildProcess child = Python(
      "libc = ctypes.CDLL(None); libc.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]\n"
      "hold()\n"
      "memory = mmap.mmap(-1, 30 * MB); touch(memory, 30 * MB); hold()\n"
      "libc.munmap(ctypes.addressof(ctypes.c_char.from_buffer(memory)) + 4096, 30 * MB - 4096); hold()\n"
      "other = mmap.mmap(-1, 10 * MB); touch(other, 10 * MB); hold()");
  TreeMeter meter(child.number(), kNoLimit);
  const double before = Look(meter);
  const auto go_on = [&] {
    child.Send("");
    EXPECT_EQ(NextAnswer(child), "held");
  };
  go_on();
  meter.Count();  // does not read the mappings
  go_on();
  ::usleep(110000);
  EXPECT_NEAR(Look(meter), before + 30, 4);
  go_on();
  ::usleep(110000);
  EXPECT_NEAR(Look(meter), before + 40, 4) << "what stays mapped hides nothing";
}

TEST(TreeMeter, CountsSharedMemoryThatIsInNobodysResidentSize) {
  EXPECT_NEAR(HeldMb("memory = mmap.mmap(-1, 20 * MB); touch(memory, 20 * MB); memory.madvise(mmap.MADV_DONTNEED)\n"
                     "private = mmap.mmap(-1, 70 * MB, mmap.MAP_PRIVATE); os.fork(); hold()"),
              25, 6);
}

/// Returns true if private memory that is only read takes memory. Most kernels map a single page of zeros there; a
/// virtual machine's kernel may not.
bool ReadsTakeMemory() {
  const auto resident_pages = [] {
    std::ifstream file("/proc/self/statm");
    long size = 0, resident = 0;
    file >> size >> resident;
    return resident;
  };
  constexpr std::size_t kPages = 1024, kPage = 4096;
  void* const memory = ::mmap(nullptr, kPages * kPage, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ::madvise(memory, kPages * kPage, MADV_NOHUGEPAGE);
  const long before = resident_pages();
  for (std::size_t page = 0; page < kPages; ++page) {
    EXPECT_EQ(static_cast<const volatile char*>(memory)[page * kPage], 0);
  }
  const long taken = resident_pages() - before;
  ::munmap(memory, kPages * kPage);
  return taken > static_cast<long>(kPages / 2);
}

TEST(TreeMeter, CountsWhatTheKernelKeepsForThem) {
  const std::string tables =
      "memory = mmap.mmap(-1, 16 << 30, mmap.MAP_PRIVATE | 0x4000, mmap.PROT_READ); memory.madvise(15)\n"
      "sum(memory[at] for at in range(0, 16 << 30, 2 * MB)); hold()";
  const double pages = ReadsTakeMemory() ? 32 : 0;
  EXPECT_NEAR(HeldMb(tables), 32 + pages, 3) << "8192 page tables; their pages are all one, or one each";
  const std::string locks =
      "file = open('/tmp/tree-meter-' + str(os.getpid()), 'w'); os.unlink(file.name)\n"
      "for at in range(4000): fcntl.fcntl(file, fcntl.F_SETLK, struct.pack('hhqqi', fcntl.F_WRLCK, 0, 2 * at, 1, 0))\n"
      "hold()";
  const ChildProcess locking = Python(locks);
  // The kernel's list is read in parts: while other programs lock and unlock, a line may appear twice or not at all.
  EXPECT_NEAR(static_cast<double>(TreeMeter(locking.number(), kNoLimit).Count().file_locks), 4000, 40);
}

/// Returns four children; the first `splitting` split their memory into 40,000 mappings each.
ChildProcess WithMappings(int splitting) {
  return Python(
      "libc = ctypes.CDLL(None); libc.mprotect.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]\n"
      "memory = mmap.mmap(-1, 20000 * 8192, mmap.MAP_PRIVATE); reading, writing = os.pipe()\n"
      "start = ctypes.addressof(ctypes.c_char.from_buffer(memory))\n"
      "for child in range(4):\n"
      "  if os.fork() == 0:\n"
      "    for at in range(20000 if child < " +
      std::to_string(splitting) +
      " else 0): libc.mprotect(start + at * 8192, 4096, 0)\n"
      "    os.write(writing, b'x'); time.sleep(60)\n"
      "for child in range(4): os.read(reading, 1)\n"
      "hold()");
}

TEST(TreeMeter, CountsMappingsUpToItsLimit) {
  constexpr double kMbEach = 40000 * 250.0 / (1 << 20);  // 9.5 MB
  const ChildProcess none = WithMappings(0), two = WithMappings(2), four = WithMappings(4);
  const auto held_mb = [](const ChildProcess& child, double limit_mb) {
    TreeMeter meter(child.number(), limit_mb);
    return Look(meter);
  };
  const double plain_mb = held_mb(none, kNoLimit);
  EXPECT_NEAR(held_mb(two, kNoLimit), plain_mb + 2 * kMbEach, 3) << "idle children behind them count for nothing";
  EXPECT_NEAR(held_mb(four, kNoLimit), plain_mb + 4 * kMbEach, 3);
  EXPECT_NEAR(held_mb(four, 1.5 * kMbEach), 2 * kMbEach, 3) << "the first two alone exceed it";
}

TEST(TreeMeter, IsStarvedByATreeThatUsesTheMachineWhileItWaits) {
  EXPECT_TRUE(Starves({.cpu_s = 0.01, .wall_s = 0.05}, 1.8, 2));
  EXPECT_FALSE(Starves({.cpu_s = 0.01, .wall_s = 0.03}, 1.8, 2)) << "it hardly waited";
  EXPECT_FALSE(Starves({.cpu_s = 0.001, .wall_s = 0.05}, 1.8, 2)) << "to measure one program costs so much";
  EXPECT_FALSE(Starves({.cpu_s = 0.01, .wall_s = 0.05}, 0.8, 2)) << "others use the machine";
}

TEST(TreeMeter, LowersThePriorityOfAllThreads) {
  const ChildProcess child = Python(
      "threading.Thread(target=time.sleep, args=(60,), daemon=True).start()\n"
      "hold()");
  const int ours = ::getpriority(PRIO_PROCESS, 0);
  const auto priorities = [&] {
    std::multiset<int> found;
    for (const auto& thread : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", child.number()))) {
      found.insert(::getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoi(thread.path().filename()))));
    }
    return found;
  };
  EXPECT_EQ(priorities(), (std::multiset<int>{ours, ours}));
  LowerPriority(child.number());
  EXPECT_EQ(priorities(), (std::multiset<int>{19, 19}));
  EXPECT_EQ(::getpriority(PRIO_PROCESS, 0), ours);
}

TEST(TreeMeter, CountsDescriptorsPipesAndThreads) {
  const ChildProcess child = Python(
      "pipes = [os.pipe() for _ in range(150)]; files = [open('/dev/null') for _ in range(10)]\n"
      "for _ in range(5): threading.Thread(target=time.sleep, args=(60,), daemon=True).start()\n"
      "hold()");
  const TreeLoad load = TreeMeter(child.number(), kNoLimit).Count();
  EXPECT_EQ(load.descriptors, 313u);
  EXPECT_NEAR(static_cast<double>(load.pipes), 152.5, 1) << "with its standard input and output, and perhaps ours";
  EXPECT_EQ(load.threads, 6u);
  EXPECT_EQ(load.sockets, 0u) << "those of a network that it shares with us are not its own";
}

// Sockets in transit over other sockets, or queued at a listener that never accepts, are open in no process.
TEST(TreeMeter, CountsSocketsThatNoProcessHasOpen) {
  const Fence fence = Fence::Find();
  if (!fence.IsUp()) GTEST_SKIP() << fence.description();
  const std::string script = std::string(kPrelude) +
                             "one, other = socket.socketpair()\n"
                             "for _ in range(50):\n"
                             "  pair = socket.socketpair(); pair[0].send(bytes(100000))\n"
                             "  socket.send_fds(one, [b'x'], [pair[1].fileno()])\n"
                             "hold()";
  const FencedCommand command = fence.Around({"/usr/bin/python3", "-c", script}, {});
  auto child = ChildProcess::Start({.program = command.words[0],
                                    .arguments = {command.words.begin() + 1, command.words.end()},
                                    .limited = true,
                                    .contained = true,
                                    .inherited_texts = command.inherited_texts});
  ASSERT_TRUE(child);
  EXPECT_EQ(NextAnswer(*child), "held");
  TreeMeter meter(child->number(), kNoLimit);
  const TreeLoad load = meter.Count();
  EXPECT_GE(load.sockets, 102u) << "each with a half that has been closed, whose bytes are still on their way";
  EXPECT_LT(load.sockets, 120u);
  EXPECT_LT(load.descriptors, 30u);
  EXPECT_GT(meter.HeldMb(0, kAlways), 5 + 40 * 0.2);
}

}  // namespace
}  // namespace etude
